#include "gsv/rendering/raster/rasteriser.h"

#include <algorithm>

namespace gsv::rendering::raster {

using geometry::Vector3;

Drawn DrawnItem(const RenderList& render_list, std::size_t item, const Level& level,
                const Vector3& origin) {
  const DrawItem& of = render_list.items()[item];
  const PlacedItem& placed = render_list.placed()[item];
  Drawn drawn;
  drawn.group = &render_list.groups()[of.group];
  drawn.mesh = static_cast<const RasterMesh*>(drawn.group->mesh.get());
  drawn.level = &level;
  drawn.factors = &of.factors;
  const auto& [x, y, z] = placed.columns;
  const Vector3 t = placed.origin - origin;
  const Vector3 rows[3] = {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}};
  const double offset[3] = {t.x, t.y, t.z};
  // Normals are transformed by the cofactors of rotation and scale. If the scale mirrors the mesh,
  // the cofactors turn normals inward, and handedness turns them back.
  const double handedness = geometry::Dot(x, geometry::Cross(y, z)) < 0 ? -1 : 1;
  const Vector3 cofactors[3] = {handedness * geometry::Cross(rows[1], rows[2]),
                                handedness * geometry::Cross(rows[2], rows[0]),
                                handedness * geometry::Cross(rows[0], rows[1])};
  for (auto& column : drawn.normal) std::fill_n(column, 8, 0.0f);
  for (int i = 0; i < 3; ++i) {
    const double row[4] = {rows[i].x, rows[i].y, rows[i].z, offset[i]};
    const double normal[3] = {cofactors[i].x, cofactors[i].y, cofactors[i].z};
    for (int k = 0; k < 4; ++k) drawn.rows[i][k] = static_cast<float>(row[k]);
    for (int k = 0; k < 3; ++k) drawn.normal[k][3 + i] = static_cast<float>(normal[k]);
  }
  return drawn;
}

void Rasteriser::Begin(int width, int height, double near, const std::array<float, 16>& clip,
                       Rows rows) {
  rows_upwards_ = rows == Rows::kUpwards;
  width_ = width, height_ = height;
  near_ = static_cast<float>(near);
  const float half[2] = {0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height)};
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 2; ++i) to_pixels_[i][k] = half[i] * (clip[4 * k + i] + clip[4 * k + 3]);
    to_pixels_[2][k] = clip[4 * k + 3];
  }
}

void Rasteriser::Project(const Drawn& drawn) {
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 4; ++k) {
      float sum = k == 3 ? to_pixels_[i][3] : 0;
      for (int j = 0; j < 3; ++j) sum += to_pixels_[i][j] * drawn.rows[j][k];
      from_mesh_[i][k] = sum;
    }
  }
  const Level& level = *drawn.level;
  if (x_.size() < level.vertex_count) {
    for (auto* values : {&x_, &y_, &inverse_w_}) values->resize(level.vertex_count);
  }
  const RasterMesh& mesh = *drawn.mesh;
  for (std::uint32_t i = 0; i < level.vertex_count; i += 8) {
    const std::uint32_t from = level.first_vertex + i;
    const F8 x = Load(&mesh.x[from]), y = Load(&mesh.y[from]), z = Load(&mesh.z[from]);
    const auto row = [&](const float(&m)[4]) {
      return Fma(Splat(m[0]), x, Fma(Splat(m[1]), y, Fma(Splat(m[2]), z, Splat(m[3]))));
    };
    const F8 w = row(from_mesh_[2]);
    const I8 behind = w < Splat(near_);
    const F8 inverse = Splat(1) / Select(behind, Splat(1), w);
    Store(&x_[i], row(from_mesh_[0]) * inverse);
    Store(&y_[i], row(from_mesh_[1]) * inverse);
    Store(&inverse_w_[i], Select(behind, Splat(0), inverse));
  }
}

int Rasteriser::SetUp(const Drawn& drawn, std::uint32_t number, std::uint32_t first,
                      bool both_sides, int& crossing) {
  const RasterMesh& mesh = *drawn.mesh;
  const std::uint32_t at = drawn.level->first_triangle + first;
  I8 corner[3];
  F8 x[3], y[3], iw[3];
  for (int i = 0; i < 3; ++i) {
    corner[i] = LoadInt(&mesh.corners[i][at]);
    x[i] = Gather(x_.data(), corner[i]);
    y[i] = Gather(y_.data(), corner[i]);
    iw[i] = Gather(inverse_w_.data(), corner[i]);
  }
  const F8 zero = Splat(0);
  const F8 nearest = Max(Max(iw[0], iw[1]), iw[2]), farthest = Min(Min(iw[0], iw[1]), iw[2]);
  const F8 min_x = Min(Min(x[0], x[1]), x[2]), max_x = Max(Max(x[0], x[1]), x[2]);
  const F8 min_y = Min(Min(y[0], y[1]), y[2]), max_y = Max(Max(y[0], y[1]), y[2]);
  // The maximum distance of a corner from pixel (0, 0) in x and in y, pixels. Beyond it, single
  // precision is too coarse. The triangle is then set up in double precision, like triangles that
  // cross the near plane.
  constexpr float kFar = 16384;
  const I8 is_far = (Max(Abs(min_x), max_x) > Splat(kFar)) | (Max(Abs(min_y), max_y) > Splat(kFar));
  const I8 crosses = ((farthest <= zero) | is_far) & (nearest > zero) &
                     ((corner[0] != corner[1]) | (corner[1] != corner[2]));
  crossing = Bits(crosses);
  const F8 area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  // Rows run downwards, so counter-clockwise triangles become clockwise.
  const bool counter_clockwise = drawn.group->mirrored != rows_upwards_;
  const I8 faces = both_sides ? area != zero : counter_clockwise ? area > zero : area < zero;
  const F8 width = Splat(static_cast<float>(width_)), height = Splat(static_cast<float>(height_));
  const auto first_pixel = [&](F8 low, F8 size) {
    return Truncated(Ceil(Min(Max(low - Splat(0.501f), zero), size)));
  };
  const auto last_pixel = [&](F8 high, F8 size) {
    return Truncated(Floor(Max(Min(high - Splat(0.499f), size - Splat(1)), Splat(-1))));
  };
  const I8 x0 = first_pixel(min_x, width), x1 = last_pixel(max_x, width);
  const I8 y0 = first_pixel(min_y, height), y1 = last_pixel(max_y, height);
  const int kept = Bits(faces & ~crosses & (farthest > zero) & (x0 <= x1) & (y0 <= y1));
  if (kept == 0) return 0;

  const F8 middle_x = ToFloat(x0) + Splat(0.5f), middle_y = ToFloat(y0) + Splat(0.5f);
  alignas(32) float a[3][8], b[3][8], c[3][8];
  alignas(32) std::int32_t corners[3][8], box[4][8];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const F8 scale = iw[i] / area;
    const F8 slope_x = (y[j] - y[k]) * scale, slope_y = (x[k] - x[j]) * scale;
    Store(a[i], slope_x);
    Store(b[i], slope_y);
    Store(c[i], Fma(slope_x, middle_x - x[j], slope_y * (middle_y - y[j])));
    StoreInt(corners[i], corner[i] + SplatInt(static_cast<int>(drawn.level->first_vertex)));
  }
  StoreInt(box[0], x0), StoreInt(box[1], y0), StoreInt(box[2], x1), StoreInt(box[3], y1);
  for (int left = kept; left != 0; left &= left - 1) {
    const int lane = __builtin_ctz(static_cast<unsigned>(left));
    Triangle& triangle = triangles_[lane];
    for (int i = 0; i < 3; ++i) {
      triangle.a[i] = a[i][lane], triangle.b[i] = b[i][lane], triangle.c[i] = c[i][lane];
      triangle.corner[i] = static_cast<std::uint32_t>(corners[i][lane]);
    }
    boxes_[lane] = {box[0][lane], box[1][lane], box[2][lane], box[3][lane]};
    triangle.x0 = static_cast<float>(box[0][lane]);
    triangle.y0 = static_cast<float>(box[1][lane]);
    triangle.drawn = number;
  }
  return kept;
}

bool Rasteriser::SetUpCrossing(const Drawn& drawn, std::uint32_t number, std::uint32_t index,
                               bool both_sides, Triangle& triangle) const {
  const RasterMesh& mesh = *drawn.mesh;
  double p[3][3];  // p[i] is corner i in homogeneous pixel coordinates (x w, y w, w)
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t v =
        drawn.level->first_vertex + mesh.corners[i][drawn.level->first_triangle + index];
    triangle.corner[i] = v;
    for (int k = 0; k < 3; ++k) {
      const float(&m)[4] = from_mesh_[k];
      p[i][k] = static_cast<double>(m[0]) * mesh.x[v] + static_cast<double>(m[1]) * mesh.y[v] +
                static_cast<double>(m[2]) * mesh.z[v] + m[3];
    }
  }
  double e[3][3];
  for (int i = 0; i < 3; ++i) {
    const double *u = p[(i + 1) % 3], *v = p[(i + 2) % 3];
    e[i][0] = u[1] * v[2] - u[2] * v[1];
    e[i][1] = u[2] * v[0] - u[0] * v[2];
    e[i][2] = u[0] * v[1] - u[1] * v[0];
  }
  const double volume = p[0][0] * e[0][0] + p[0][1] * e[0][1] + p[0][2] * e[0][2];
  if (volume == 0) return false;
  const bool counter_clockwise = drawn.group->mirrored != rows_upwards_;
  if (!both_sides && (counter_clockwise ? volume < 0 : volume > 0)) return false;
  for (int i = 0; i < 3; ++i) {
    triangle.a[i] = static_cast<float>(e[i][0] / volume);
    triangle.b[i] = static_cast<float>(e[i][1] / volume);
    triangle.c[i] = static_cast<float>((e[i][2] + 0.5 * e[i][0] + 0.5 * e[i][1]) / volume);
  }
  triangle.x0 = triangle.y0 = 0;
  triangle.drawn = number;
  return true;
}

}  // namespace gsv::rendering::raster
