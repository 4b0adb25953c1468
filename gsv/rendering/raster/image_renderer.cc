#include "gsv/rendering/raster/image_renderer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>

#include "gsv/rendering/scene/antialiasing.h"

namespace gsv::rendering::raster {
namespace {

using geometry::Vector3;

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
  Light(shadow, team);
  Blend(view, render_list, shadow);
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
  stride_ = width_ + kMaxLanes;
  const std::size_t with_one_more_row = At(0, height_ + 1);
  inverse_w_.assign(with_one_more_row, static_cast<float>(1 / view.parameters.far));
  nearest_.assign(with_one_more_row, 0);
  rgba_.resize(static_cast<std::size_t>(width_) * height_ + kMaxLanes);
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
  in_progress_ = {width_,
                  height_,
                  stride_,
                  inverse_w_.data(),
                  nearest_.data(),
                  rgba_.data(),
                  nullptr,
                  forward_,
                  right_,
                  down_,
                  static_cast<float>(1 / view.parameters.near)};
  if (loops_.empty()) loops_.push_back(make_loops_());
  for (const auto& loops : loops_) loops->Begin(in_progress_);
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
    CoverWith(static_cast<std::uint32_t>(drawn_.size() - 1));
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
      if (Any(inside & (Load(&inverse_w_[At(x, y)]) < nearest))) return false;
    }
  }
  return true;
}

void ImageRenderer::CoverWith(std::uint32_t number) {
  const Drawn& drawn = drawn_[number];
  PixelLoops& loops = *loops_.front();
  const float back = drawn.group->ground ? kGroundBack : 1.0f;
  rasteriser_.ForEachTriangle(drawn, number, drawn.group->double_sided,
                              [&](const Triangle& t, const Box& box, bool crosses_near) {
                                const auto id = static_cast<std::uint32_t>(triangles_.size() + 1);
                                if (loops.Cover(drawn, t, box, crosses_near, id, back))
                                  triangles_.push_back(t);
                              });
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

void ImageRenderer::Light(const SunShadow* shadow, base::ThreadTeam* team) {
  const std::size_t threads = team == nullptr ? 1 : static_cast<std::size_t>(team->threads());
  while (loops_.size() < threads) {
    loops_.push_back(make_loops_());
    loops_.back()->Begin(in_progress_);
  }
  const VisibleTriangles visible{triangles_, drawn_};
  std::atomic<int> next_row{0};
  const auto work = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      bool has_begun = false;
      for (int y = 0; (y = next_row++ * kTileHeight) < height_;) {
        if (!has_begun) loops_[i]->BeginShading(visible, background_.block, shadow);
        has_begun = true;
        for (int x = 0; x < width_; x += kTileWidth) LightTile(*loops_[i], shadow, x, y);
      }
    }
  };
  if (team == nullptr) return work(0, 1);
  team->ParallelFor(threads, 1, work);
}

void ImageRenderer::LightTile(PixelLoops& loops, const SunShadow* shadow, int x0, int y0) {
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
  const TileToShade to_shade = loops.TileAt(x0, y0, x1, y1);
  loops.Shade(to_shade);
  if (is_still) tile.in_shadow = InShadow(to_shade);
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
ShadowRegion::Rectangle ImageRenderer::InShadow(const TileToShade& box) const {
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

void ImageRenderer::Blend(const CameraView& view, const RenderList& render_list,
                          const SunShadow* shadow) {
  if (transparent_.empty()) return;
  is_blended_.assign(tiles_.size(), 0);
  in_progress_.is_blended = is_blended_.data();
  PixelLoops& loops = *loops_.front();
  loops.Begin(in_progress_);
  loops.BeginShading({}, background_.block, shadow);
  for (const Seen& seen : transparent_) {
    const Drawn drawn =
        DrawnItem(render_list, seen.item, *seen.level, view.world_from_camera.position);
    loops.BeginBlending(drawn,
                        render_list.placed()[seen.item].centre - view.world_from_camera.position,
                        render_list.items()[seen.item].radius);
    rasteriser_.ForEachTriangle(
        drawn, 0, drawn.group->double_sided,
        [&](const Triangle& t, const Box& box, bool) { loops.Blend(t, box); });
  }
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    if (is_blended_[i] != 0) tiles_[i].is_kept = false;
  }
}

}  // namespace gsv::rendering::raster
