#include "gsv/rendering/raster/sun_shadow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gsv/rendering/raster/raster_texture.h"
#include "gsv/rendering/raster/scan.h"

namespace gsv::rendering::raster {
namespace {

constexpr int kStride = kShadowSide + 16;
constexpr int kFirst = kStride + 1;  // the index of texel (0, 0) of the map without its border

// The detail of casters in the shadow map, in texels. Shadows of robots are rendered for each
// snapshot, so they have less detail. Other objects always have full detail, because the image must
// not depend on whether an object has moved.
struct Fineness {
  double moved_by;  // the approximate maximum displacement of a caster's vertices
  double smallest;  // the minimum radius of a caster
};
constexpr Fineness kThing{0.5, 0.5}, kRobot{3, 1.5};

// Returns the coarsest level whose vertices are displaced by at most `moved_by` and by a third of
// the radius.
const Level& LevelFor(const std::vector<Level>& levels, const DrawItem& item, double moved_by) {
  const double scale =
      std::max({std::abs(item.scale.x), std::abs(item.scale.y), std::abs(item.scale.z)});
  const Level* level = &levels.front();
  for (const Level& coarser : levels) {
    if (coarser.cell * scale <= std::min(moved_by, item.radius / 3)) level = &coarser;
  }
  return *level;
}

}  // namespace

void SunShadow::Draw(const RenderList& render_list, std::uint64_t render_list_id,
                     const geometry::Vector3& to_sun, const std::vector<CameraView>& views) {
  region_ = ShadowRegion(render_list, to_sun);
  if (region_.IsEmpty()) return;
  const Drawn wanted{render_list_id, render_list.moved_count(), region_};
  std::vector<ShadowRegion::Rectangle> changed = std::move(moved_);
  if (drawn_ != wanted) {
    still_.assign(std::size_t{kStride} * (kShadowSide + 2), 0.0f);
    DrawCasters(render_list, ShadowRegion::StillCasters(render_list), still_);
    drawn_ = wanted;
    moving_ = still_;
    changed = {{0, 0, kShadowSide, kShadowSide}};
  } else {
    for (const ShadowRegion::Rectangle& part : changed) CopyStill(part);
  }
  const std::vector<std::size_t> moving = region_.MovingCasters(render_list, views);
  moved_ = region_.PartsOf(render_list, moving);
  DrawCasters(render_list, moving, moving_);
  changed.insert(changed.end(), moved_.begin(), moved_.end());
  for (const ShadowRegion::Rectangle& part : changed) {
    // A caster at the map's edge may be drawn into the texels beyond it.
    bounds_.Update(&moving_[kFirst], kStride, {part.min_x, part.min_y, part.max_x + 1, part.max_y});
  }
}

void SunShadow::CopyStill(const ShadowRegion::Rectangle& part) {
  for (int y = part.min_y; y < part.max_y; ++y) {
    const std::ptrdiff_t row = kFirst + std::ptrdiff_t{kStride} * y;
    std::copy(still_.begin() + row + part.min_x, still_.begin() + row + part.max_x,
              moving_.begin() + row + part.min_x);
  }
}

void SunShadow::DrawCasters(const RenderList& render_list, const std::vector<std::size_t>& casters,
                            std::vector<float>& map) {
  FrameBlock block{};
  region_.Describe({}, block);
  // Converts the map's x and y, from 0 to 1, to clip space, from -1 to 1.
  std::array<float, 16> clip = block.shadow_from_relative;
  float depth_row[4];
  for (int column = 0; column < 4; ++column) {
    depth_row[column] = clip[4 * column + 2];
    for (int row = 0; row < 2; ++row) {
      float& m = clip[4 * column + row];
      m = 2 * m - (column == 3 ? 1.0f : 0.0f);
    }
  }
  rasteriser_.Begin(kShadowSide, kShadowSide, 0.5, clip, Rasteriser::Rows::kUpwards);
  for (const std::size_t i : casters) {
    const DrawItem& item = render_list.items()[i];
    const Fineness fineness = item.of_robot ? kRobot : kThing;
    if (item.radius <= fineness.smallest * region_.TexelSize()) continue;
    const DrawGroup& group = render_list.groups()[item.group];
    const auto& mesh = static_cast<const RasterMesh&>(*group.mesh);
    const Level& level =
        LevelFor(mesh.levels[group.chunk], item, fineness.moved_by * region_.TexelSize());
    DrawCaster(DrawnItem(render_list, i, level, {}), depth_row, !item.of_robot, map);
  }
}

void SunShadow::DrawCaster(const raster::Drawn& caster, const float (&depth_row)[4],
                           bool both_sides, std::vector<float>& map) {
  const RasterMesh& mesh = *caster.mesh;
  float row[4];  // computes the depth from a mesh vertex
  for (int k = 0; k < 4; ++k) {
    row[k] = k == 3 ? depth_row[3] : 0;
    for (int j = 0; j < 3; ++j) row[k] += depth_row[j] * caster.rows[j][k];
  }
  const auto* holes = caster.group->blending == Blending::kAlphaMask
                          ? static_cast<const RasterTexture*>(caster.group->base_colour.get())
                          : nullptr;
  rasteriser_.ForEachTriangle(
      caster, 0, both_sides || caster.group->double_sided,
      [&](const Triangle& t, const Box& box, bool) {
        float a = 0, b = 0, c = 0;
        for (int i = 0; i < 3; ++i) {
          const std::uint32_t v = t.corner[i];
          const float z = row[0] * mesh.x[v] + row[1] * mesh.y[v] + row[2] * mesh.z[v] + row[3];
          a += t.a[i] * z, b += t.b[i] * z, c += t.c[i] * z;
        }
        // Moves the depth away from the sun by its change over a texel, so that no surface shades
        // itself.
        c -= 1.5f * std::max(std::abs(a), std::abs(b)) + 2e-7f;
        Scan(t, box, [&](int x, int y, I8 covered, F8) {
          const F8 dx = Splat(static_cast<float>(x) - t.x0) + Steps();
          const float dy = static_cast<float>(y) - t.y0;
          if (holes != nullptr) covered &= Solid(t, mesh, *holes, 0, dx, dy);
          const F8 z = Fma(Splat(a), dx, Splat(c + b * dy));
          float* at = &map[static_cast<std::size_t>(kFirst + std::ptrdiff_t{kStride} * y + x)];
          const F8 old = Load(at);
          Store(at, Select(covered & (z > old), z, old));
        });
      });
}

F8 SunShadow::Lit(F8 x, F8 y, F8 z) const {
  // The centre of texel (0, 0) is at 0.5.
  const F8 px = x - Splat(0.5f), py = y - Splat(0.5f);
  const F8 whole_x = Floor(px), whole_y = Floor(py);
  const F8 fx = px - whole_x, fy = py - whole_y;
  const I8 at = (Truncated(whole_y) + 1) * SplatInt(kStride) + Truncated(whole_x) + 1;
  const float* map = moving_.data();
  const auto row = [&](int offset) {
    const I8x2 depths = GatherPairs(map + offset, at);
    const F8 left = Select(z >= (F8)depths.first, Splat(1), Splat(0));
    const F8 right = Select(z >= (F8)depths.second, Splat(1), Splat(0));
    return Fma(right - left, fx, left);
  };
  const F8 top = row(0), bottom = row(kStride);
  return Fma(bottom - top, fy, top);
}

F8 SunShadow::Visible(const F8x3& point, I8 needed) const {
  const F8 side = Splat(kShadowSide);
  // Points outside the map use the border texels, which cast no shadow.
  const auto inside = [&](F8 at) { return Min(Max(at, Splat(-0.5f)), side + Splat(0.4f)); };
  const F8 x = point.x * side, y = point.y * side;
  const F8 z = Max(point.z, Splat(0));  // below the map, use the height of its lowest layer
  const ShadowBounds::Range range = bounds_.At(x, y);
  const I8 is_lit = z >= range.max, is_shaded = z < range.min;
  if (Bits(needed & ~(is_lit | is_shaded)) == 0) return Select(is_lit, Splat(1), Splat(0));
  const F8 first = Lit(inside(x - Splat(0.6f)), inside(y - Splat(0.3f)), z);
  const F8 second = Lit(inside(x + Splat(0.6f)), inside(y + Splat(0.3f)), z);
  return Splat(0.5f) * (first + second);
}

}  // namespace gsv::rendering::raster
