#include "gsv/rendering/raster/image_renderer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include "gsv/rendering/raster/raster_texture.h"
#include "gsv/rendering/raster/scan.h"
#include "gsv/rendering/scene/antialiasing.h"

namespace gsv::rendering::raster {
namespace {

using geometry::Vector3;

constexpr int kTileWidth = 32, kTileHeight = 16;
// The ground is moved back: its 1/w (w is the distance along the view) is multiplied by this
// factor, so that objects on the ground hide it.
constexpr float kGroundBack = 1 - 2e-4f;

// Returns the coarsest level of detail whose vertices are displaced by at most about a pixel.
const Level& LevelFor(const std::vector<Level>& levels, double pixel_in_mesh) {
  const Level* level = &levels.front();
  for (const Level& coarser : levels) {
    if (coarser.cell <= pixel_in_mesh) level = &coarser;
  }
  return *level;
}

bool IsSameView(const CameraView& a, const CameraView& b) {
  const geometry::Pose &p = a.world_from_camera, &q = b.world_from_camera;
  return a.parameters == b.parameters && p.position == q.position && p.orientation == q.orientation;
}

bool Overlap(const ShadowRegion::Rectangle& a, const ShadowRegion::Rectangle& b) {
  return a.min_x < b.max_x && b.min_x < a.max_x && a.min_y < b.max_y && b.min_y < a.max_y;
}

}  // namespace

bool ImageRenderer::IsOf(const CameraView& view) const {
  return background_.render_list_id != 0 && IsSameView(background_.view, view);
}

model::Image ImageRenderer::Draw(const CameraView& view, const RenderList& render_list,
                                 std::uint64_t render_list_id, const FrameBlock& block,
                                 const SunShadow* shadow, base::ThreadTeam* team) {
  Begin(view, block);
  SetBackground({view, render_list_id, render_list.moved_count(), shadow != nullptr, block});
  FindVisible(view, render_list);
  Cover(view, render_list);
  const LightModel light(background_.block, shadow);
  Light(light, shadow, team);
  Blend(view, render_list, light);
  return Smooth();
}

DepthGrid ImageRenderer::SampleDepth(int spacing) const {
  return MakeDepthGrid(width_, height_, spacing, [this](int x, int y) {
    const std::uint32_t triangle = nearest_[At(x, y)];
    if (triangle == 0) return 0.0f;
    const bool is_ground = drawn_[triangles_[triangle - 1].drawn].group->ground;
    return inverse_w_[At(x, y)] / (is_ground ? kGroundBack : 1.0f);
  });
}

GroundTruth ImageRenderer::DrawGroundTruth(const CameraView& view, const RenderList& render_list,
                                           const FrameBlock& block) {
  Begin(view, block);
  background_.render_list_id = 0;
  FindVisible(view, render_list);
  Cover(view, render_list);
  GroundTruth truth{width_, height_, {}, {}, {}};
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  truth.depth.assign(pixels, std::numeric_limits<float>::infinity());
  truth.body.assign(pixels, -1);
  truth.visual.assign(pixels, -1);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const std::uint32_t triangle = nearest_[At(x, y)];
      if (triangle == 0) continue;
      const std::uint32_t drawn = triangles_[triangle - 1].drawn;
      const std::size_t pixel = static_cast<std::size_t>(y) * width_ + x;
      const float back = drawn_[drawn].group->ground ? kGroundBack : 1.0f;
      truth.depth[pixel] = back / inverse_w_[At(x, y)];
      truth.body[pixel] = body_of_[drawn];
      truth.visual[pixel] = visual_of_[drawn];
    }
  }
  return truth;
}

model::Image ImageRenderer::Smooth() const {
  return SmoothAliasedEdges(width_, height_, reinterpret_cast<const std::uint8_t*>(rgba_.data()));
}

void ImageRenderer::Begin(const CameraView& view, const FrameBlock& block) {
  width_ = view.parameters.width, height_ = view.parameters.height;
  stride_ = width_ + 8;
  const std::size_t pixels = At(0, height_);
  inverse_w_.assign(pixels, static_cast<float>(1 / view.parameters.far));
  nearest_.assign(pixels, 0);
  rgba_.resize(static_cast<std::size_t>(width_) * height_ + 8);
  triangles_.clear();
  drawn_.clear();
  is_still_.clear();
  body_of_.clear();
  visual_of_.clear();
  // The centre of pixel (x, y) is at x = (2 x + 1) / width - 1 in clip space, and likewise for y.
  for (int i = 0; i < 3; ++i) {
    right_[i] = 2 * block.view_right[i] / static_cast<float>(width_);
    down_[i] = 2 * block.view_down[i] / static_cast<float>(height_);
    forward_[i] = block.view_forward[i] - block.view_right[i] - block.view_down[i] +
                  0.5f * right_[i] + 0.5f * down_[i];
  }
  rasteriser_.Begin(width_, height_, view.parameters.near, block.clip_from_relative,
                    Rasteriser::Rows::kDownwards);
}

void ImageRenderer::FindVisible(const CameraView& view, const RenderList& render_list) {
  // Smaller objects are not drawn, because they would only flicker.
  constexpr double kMinPixels = 0.3;
  const Frustum frustum = FrustumOf(view);
  const double pixel = 1 / FocalLength(view.parameters);  // the size of a pixel at 1 m
  solid_.clear();
  transparent_.clear();
  for (std::size_t i = 0; i < render_list.items().size(); ++i) {
    const DrawItem& item = render_list.items()[i];
    const Vector3 centre = render_list.placed()[i].centre - view.world_from_camera.position;
    if (!frustum.MeetsSphere(centre, item.radius)) continue;
    const double distance = geometry::Norm(centre);
    if (item.radius < kMinPixels * pixel * distance) continue;
    const DrawGroup& group = render_list.groups()[item.group];
    const double scale =
        std::max({std::abs(item.scale.x), std::abs(item.scale.y), std::abs(item.scale.z)});
    const double nearest = std::max(0.0, distance - item.radius);
    const auto& levels = static_cast<const RasterMesh&>(*group.mesh).levels[group.chunk];
    (group.blending == Blending::kTransparent ? transparent_ : solid_)
        .push_back({group.blending == Blending::kTransparent ? distance : distance - item.radius, i,
                    &LevelFor(levels, pixel * nearest / scale)});
  }
  std::sort(solid_.begin(), solid_.end(), [&](const Seen& a, const Seen& b) {
    const bool a_ground = render_list.groups()[render_list.items()[a.item].group].ground;
    const bool b_ground = render_list.groups()[render_list.items()[b.item].group].ground;
    if (a_ground != b_ground) return b_ground;
    return a.distance != b.distance ? a.distance < b.distance : a.item < b.item;
  });
  std::sort(transparent_.begin(), transparent_.end(), [](const Seen& a, const Seen& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.item < b.item;
  });
}

void ImageRenderer::Cover(const CameraView& view, const RenderList& render_list) {
  for (const Seen& seen : solid_) {
    const Vector3 centre = render_list.placed()[seen.item].centre - view.world_from_camera.position;
    if (IsHidden(view, centre, render_list.items()[seen.item].radius)) continue;
    drawn_.push_back(
        DrawnItem(render_list, seen.item, *seen.level, view.world_from_camera.position));
    is_still_.push_back(render_list.IsStill(render_list.items()[seen.item].body) ? 1 : 0);
    body_of_.push_back(render_list.items()[seen.item].body);
    visual_of_.push_back(render_list.items()[seen.item].visual);
    CoverWith(static_cast<std::uint32_t>(drawn_.size() - 1),
              static_cast<float>(1 / view.parameters.near));
  }
}

// Whether the items that are already drawn hide a sphere.
bool ImageRenderer::IsHidden(const CameraView& view, const Vector3& centre, double radius) const {
  const geometry::Quaternion& q = view.world_from_camera.orientation;
  const double ahead = geometry::Dot(q * Vector3{1, 0, 0}, centre);
  const double begin = ahead - radius, end = ahead + radius;
  if (begin <= view.parameters.near) return false;
  const double f = FocalLength(view.parameters);
  const auto range = [&](double middle, int size, int& first, int& last) {
    const double low = middle - radius, high = middle + radius;
    first = static_cast<int>(
        std::clamp(0.5 * size + f * low / (low < 0 ? begin : end) - 1, 0.0, size - 1.0));
    last = static_cast<int>(
        std::clamp(0.5 * size + f * high / (high > 0 ? begin : end) + 1, 0.0, size - 1.0));
  };
  int x0, x1, y0, y1;
  range(-geometry::Dot(q * Vector3{0, 1, 0}, centre), width_, x0, x1);
  range(-geometry::Dot(q * Vector3{0, 0, 1}, centre), height_, y0, y1);
  const F8 nearest = Splat(static_cast<float>(1 / begin));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; x += 8) {
      const I8 inside = IntSteps() <= SplatInt(x1 - x);
      if (Bits(inside & (Load(&inverse_w_[At(x, y)]) < nearest)) != 0) return false;
    }
  }
  return true;
}

void ImageRenderer::CoverWith(std::uint32_t number, float nearest) {
  const Drawn& drawn = drawn_[number];
  const DrawGroup& group = *drawn.group;
  const auto* holes = group.blending == Blending::kAlphaMask
                          ? static_cast<const RasterTexture*>(group.base_colour.get())
                          : nullptr;
  const F8 back = Splat(group.ground ? kGroundBack : 1.0f);
  rasteriser_.ForEachTriangle(
      drawn, number, group.double_sided, [&](const Triangle& t, const Box& box, bool crosses_near) {
        const auto id = static_cast<std::int32_t>(triangles_.size() + 1);
        bool is_seen = false;
        Scan(t, box, [&](int x, int y, I8 covered, F8 inverse_w) {
          const std::size_t at = At(x, y);
          const F8 old = Load(&inverse_w_[at]);
          I8 visible = covered & (inverse_w * back > old);
          if (crosses_near) visible &= inverse_w <= Splat(nearest);
          if (Bits(visible) == 0) return;
          if (holes != nullptr) {
            visible &=
                Solid(t, *drawn.mesh, *holes, 0, Splat(static_cast<float>(x) - t.x0) + Steps(),
                      static_cast<float>(y) - t.y0);
          }
          Store(&inverse_w_[at], Select(visible, inverse_w * back, old));
          StoreInt(&nearest_[at], SelectInt(visible, SplatInt(id), LoadInt(&nearest_[at])));
          is_seen = true;
        });
        if (is_seen) triangles_.push_back(t);
      });
}

F8x3 ImageRenderer::RayAt(int x, int y) const {
  const F8 px = Splat(static_cast<float>(x)) + Steps();
  const float py = static_cast<float>(y);
  const auto part = [&](int i) {
    return Fma(Splat(right_[i]), px, Splat(forward_[i] + down_[i] * py));
  };
  return {part(0), part(1), part(2)};
}

void ImageRenderer::SetBackground(const Background& background) {
  const Background& old = background_;
  const bool is_same = old.render_list_id == background.render_list_id &&
                       old.moved_count == background.moved_count &&
                       old.has_shadow == background.has_shadow &&
                       IsSameView(old.view, background.view) &&
                       std::memcmp(&old.block, &background.block, sizeof old.block) == 0;
  is_repeated_ = is_same;
  if (is_same) return;
  background_ = background;
  const int columns = (width_ + kTileWidth - 1) / kTileWidth;
  const int rows = (height_ + kTileHeight - 1) / kTileHeight;
  tiles_.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), {});
}

void ImageRenderer::Light(const LightModel& light, const SunShadow* shadow,
                          base::ThreadTeam* team) {
  const std::size_t threads = team == nullptr ? 1 : static_cast<std::size_t>(team->threads());
  if (shadings_.size() < threads) shadings_.resize(threads);
  std::atomic<int> next_row{0};
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Shading& shading = shadings_[i];
      shading.surface_of.clear();
      shading.surfaces.clear();
      for (int y = 0; (y = next_row++ * kTileHeight) < height_;) {
        if (shading.surface_of.empty()) shading.surface_of.assign(triangles_.size(), -1);
        for (int x = 0; x < width_; x += kTileWidth) LightTile(light, shadow, x, y, shading);
      }
    }
  };
  if (team == nullptr) return work(0, 1);
  team->ParallelFor(threads, 1, work);
}

void ImageRenderer::LightTile(const LightModel& light, const SunShadow* shadow, int x0, int y0,
                              Shading& shading) {
  const int x1 = std::min(x0 + kTileWidth, width_), y1 = std::min(y0 + kTileHeight, height_);
  const int columns = (width_ + kTileWidth - 1) / kTileWidth;
  Tile& tile = tiles_[static_cast<std::size_t>(y0 / kTileHeight * columns + x0 / kTileWidth)];
  const auto is_shaded_by_movers = [&] {
    return shadow != nullptr &&
           std::any_of(shadow->moved().begin(), shadow->moved().end(),
                       [&](const auto& part) { return Overlap(part, tile.in_shadow); });
  };
  const bool is_still = is_repeated_ && IsStillTile(x0, y0, x1, y1);
  if (tile.is_kept && is_still && !is_shaded_by_movers()) return;
  const TileBox box = BoxOfTile(x0, y0, x1, y1);
  const Lamps lamps = box.is_empty ? Lamps() : light.Reaching(box.min, box.max);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; x += 8) Light(light, lamps, x, y, shading);
  }
  if (is_still) tile.in_shadow = InShadow(box);
  tile.is_kept = is_still && !is_shaded_by_movers();
}

// Whether all pixels of the tile show still bodies or the sky.
bool ImageRenderer::IsStillTile(int x0, int y0, int x1, int y1) const {
  std::uint32_t last = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; x += 8) {
      const I8 ids = LoadInt(&nearest_[At(x, y)]);
      if (x + 8 <= x1 && Bits(ids == SplatInt(static_cast<std::int32_t>(last))) == 0xff) continue;
      for (int i = x; i < std::min(x + 8, x1); ++i) {
        const std::uint32_t id = nearest_[At(i, y)];
        if (id == last || id == 0) continue;
        if (is_still_[triangles_[id - 1].drawn] == 0) return false;
        last = id;
      }
    }
  }
  return true;
}

// Returns the texels of the shadow map that points of the tile may look up.
ShadowRegion::Rectangle ImageRenderer::InShadow(const TileBox& box) const {
  // The maximum distance, in texels, between a point and the texels that it looks up: the
  // displacement along the normal plus the width of the filter.
  constexpr float kBeside = 4;
  if (box.is_empty) return {0, 0, 0, 0};
  const std::array<float, 16>& m = background_.block.shadow_from_relative;
  float min[2], max[2];
  for (int row = 0; row < 2; ++row) {
    min[row] = max[row] = m[static_cast<std::size_t>(12 + row)];
    const double low[3] = {box.min.x, box.min.y, box.min.z};
    const double high[3] = {box.max.x, box.max.y, box.max.z};
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<double>(m[static_cast<std::size_t>(4 * i + row)]);
      min[row] += static_cast<float>(std::min(k * low[i], k * high[i]));
      max[row] += static_cast<float>(std::max(k * low[i], k * high[i]));
    }
  }
  // Points outside the map look up the texels at its border.
  const auto texel = [](float at, float beside) {
    constexpr float kSide = kShadowSide;
    return static_cast<int>(std::clamp(at * kSide + beside, -1.0f, kSide + 1));
  };
  return {texel(min[0], -kBeside), texel(min[1], -kBeside), texel(max[0], kBeside),
          texel(max[1], kBeside)};
}

ImageRenderer::TileBox ImageRenderer::BoxOfTile(int x0, int y0, int x1, int y1) const {
  F8 most = Splat(0), least = Splat(1e30f);  // the extremes of 1/w in the tile
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; x += 8) {
      const I8 seen = (LoadInt(&nearest_[At(x, y)]) != 0) & (IntSteps() < SplatInt(x1 - x));
      const F8 inverse_w = Load(&inverse_w_[At(x, y)]);
      most = Max(most, Select(seen, inverse_w, most));
      least = Min(least, Select(seen, inverse_w, least));
    }
  }
  float nearest = most[0], farthest = least[0];
  for (int lane = 1; lane < 8; ++lane) {
    nearest = std::max(nearest, most[lane]);
    farthest = std::min(farthest, least[lane]);
  }
  if (nearest == 0) return {};
  constexpr double kMax = 1e30;
  TileBox box{false, {kMax, kMax, kMax}, {-kMax, -kMax, -kMax}};
  Vector3 &min = box.min, &max = box.max;
  for (const int x : {x0, x1}) {
    for (const int y : {y0, y1}) {
      for (const float inverse_w : {nearest, farthest}) {
        const auto part = [&](int i) {
          const double px = x - 0.5, py = y - 0.5;
          return (forward_[i] + right_[i] * px + down_[i] * py) / static_cast<double>(inverse_w);
        };
        const Vector3 p{part(0), part(1), part(2)};
        min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
        max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
      }
    }
  }
  return box;
}

void ImageRenderer::Light(const LightModel& light, const Lamps& lamps, int x, int y,
                          Shading& shading) {
  const std::size_t at = At(x, y);
  const I8 ids = LoadInt(&nearest_[at]);
  const F8x3 ray = RayAt(x, y);
  const int in_image = x + 8 <= width_ ? 0xff : (1 << (width_ - x)) - 1;
  const I8 used = (ids != 0) & (IntSteps() < SplatInt(width_ - x));
  int left = Bits(used);
  const bool sky = left != in_image;
  F8x3 colour = Splat(0, 0, 0);
  Surfaces surfaces;
  surfaces.number = SplatInt(0);
  if (left != 0) {
    bool is_first = true;
    while (left != 0) {
      const int lane = __builtin_ctz(static_cast<unsigned>(left));
      const std::uint32_t id = nearest_[at + static_cast<std::size_t>(lane)];
      const I8 mask = ids == SplatInt(static_cast<std::int32_t>(id));
      const Triangle& triangle = triangles_[id - 1];
      const Drawn& drawn = drawn_[triangle.drawn];
      std::int32_t& place = shading.surface_of[id - 1];
      if (place < 0) {
        place = static_cast<std::int32_t>(shading.surfaces.size());
        shading.surfaces.push_back(SurfaceOf(drawn, triangle));
      }
      FillIn(drawn, triangle, shading.surfaces[static_cast<std::size_t>(place)], x, y, mask,
             is_first, ray, surfaces);
      is_first = false;
      left &= ~Bits(mask);
    }
    colour = light.Colour(surfaces, ray, lamps, used);
  }
  if (sky) colour = Select(ids == 0, light.Sky(ray), colour);
  const I8 rgba = Encoded(colour, SelectInt(ids == 0, SplatInt(0), surfaces.number));
  std::uint32_t* to = &rgba_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)];
  if (in_image == 0xff) {
    StoreInt(to, rgba);
  } else {
    // The last pixels of a row: the next row must not be written, not even with its own values,
    // because another thread may draw it now.
    std::array<std::uint32_t, 8> last;
    StoreInt(last.data(), rgba);
    std::copy_n(last.begin(), width_ - x, to);
  }
}

void ImageRenderer::Blend(const CameraView& view, const RenderList& render_list,
                          const LightModel& light) {
  const F8 near = Splat(static_cast<float>(1 / view.parameters.near));
  const int columns = (width_ + kTileWidth - 1) / kTileWidth;
  for (const Seen& seen : transparent_) {
    const Drawn drawn =
        DrawnItem(render_list, seen.item, *seen.level, view.world_from_camera.position);
    // Most items are so small that few lamps reach them.
    const Vector3 centre = render_list.placed()[seen.item].centre - view.world_from_camera.position;
    const double radius = render_list.items()[seen.item].radius;
    const Vector3 to_corner{radius, radius, radius};
    const Lamps lamps = light.Reaching(centre - to_corner, centre + to_corner);
    rasteriser_.ForEachTriangle(
        drawn, 0, drawn.group->double_sided, [&](const Triangle& t, const Box& box, bool) {
          const TriangleSurface surface = SurfaceOf(drawn, t);
          Scan(t, box, [&](int x, int y, I8 covered, F8 inverse_w) {
            const I8 in_image = IntSteps() < SplatInt(width_ - x);
            const I8 visible = covered & in_image & (inverse_w <= near) &
                               (inverse_w > Load(&inverse_w_[At(x, y)]));
            if (Bits(visible) == 0) return;
            tiles_[static_cast<std::size_t>(y / kTileHeight * columns + x / kTileWidth)].is_kept =
                tiles_[static_cast<std::size_t>(y / kTileHeight * columns +
                                                std::min(x + 7, width_ - 1) / kTileWidth)]
                    .is_kept = false;
            const F8x3 ray = RayAt(x, y);
            Surfaces surfaces;
            FillIn(drawn, t, surface, x, y, visible, true, ray, surfaces);
            const I8 above = Encoded(light.Colour(surfaces, ray, lamps, visible), SplatInt(0));
            std::uint32_t* to =
                &rgba_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)];
            const I8 below = LoadInt(to);
            // The alpha channel keeps the number of the opaque surface.
            I8 mixed = below & SplatInt(static_cast<std::int32_t>(0xff000000u));
            for (int shift = 0; shift < 24; shift += 8) {
              const F8 a = ToFloat((above >> shift) & SplatInt(0xff)),
                       b = ToFloat((below >> shift) & SplatInt(0xff));
              mixed |= Truncated(Fma(a - b, surfaces.alpha, b + Splat(0.5f))) << shift;
            }
            StoreInt(to, SelectInt(visible, mixed, below));
          });
        });
  }
}

}  // namespace gsv::rendering::raster
