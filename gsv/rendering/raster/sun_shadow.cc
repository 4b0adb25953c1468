#include "gsv/rendering/raster/sun_shadow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gsv/rendering/raster/raster_texture.h"
#include "gsv/rendering/raster/scan.h"
#include "gsv/rendering/raster/surface.h"

namespace gsv::rendering::raster {
namespace {

// The detail of casters in the shadow map, in texels. Shadows of robots are rendered for each
// snapshot, so they have less detail. Other objects always have full detail, because the image must
// not depend on whether an object has moved.
struct Fineness {
  double moved_by;  // the approximate maximum displacement of a caster's vertices
  double smallest;  // the minimum radius of a caster
};
constexpr Fineness kThing{0.5, 0.5}, kRobot{3, 1.5};

// Returns the coarsest level whose vertices are displaced by at most `moved_by` and at most a third
// of the item's radius.
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
                     const geometry::Vector3& to_sun, const std::vector<CameraView>& views,
                     base::ThreadTeam& team) {
  region_ = ShadowRegion(render_list, to_sun);
  if (region_.IsEmpty()) return;
  const Drawn wanted{render_list_id, render_list.moved_count(), region_};
  std::vector<ShadowRegion::Rectangle> changed = std::move(moved_), copied;
  if (drawn_ != wanted) {
    still_.assign(std::size_t{kStride} * (kShadowSide + 2), 0.0f);
    DrawCasters(render_list, ShadowRegion::StillCasters(render_list), {}, still_, team);
    drawn_ = wanted;
    moving_ = still_;
    changed = {{0, 0, kShadowSide, kShadowSide}};
  } else {
    copied = changed;
  }
  const std::vector<std::size_t> moving = region_.MovingCasters(render_list, views);
  moved_ = region_.PartsOf(render_list, moving);
  DrawCasters(render_list, moving, copied, moving_, team);
  changed.insert(changed.end(), moved_.begin(), moved_.end());
  // A caster at the map's right edge may also be drawn into the border texels beyond the edge.
  for (ShadowRegion::Rectangle& part : changed) ++part.max_x;
  bounds_.Update(&moving_[kFirst], kStride, changed, team);
}

void SunShadow::CopyStill(const ShadowRegion::Rectangle& part, const Band& band) {
  for (int y = std::max(part.min_y, band.begin); y < std::min(part.max_y, band.end); ++y) {
    const std::ptrdiff_t row = kFirst + std::ptrdiff_t{kStride} * y;
    std::copy(still_.begin() + row + part.min_x, still_.begin() + row + part.max_x,
              moving_.begin() + row + part.min_x);
  }
}

std::vector<SunShadow::Caster> SunShadow::CastersOf(
    const RenderList& render_list, const std::vector<std::size_t>& items,
    const std::array<float, 16>& shadow_from_relative) const {
  std::vector<Caster> casters;
  for (const std::size_t i : items) {
    const DrawItem& item = render_list.items()[i];
    const Fineness fineness = item.of_robot ? kRobot : kThing;
    if (item.radius <= fineness.smallest * region_.TexelSize()) continue;
    const DrawGroup& group = render_list.groups()[item.group];
    const auto& mesh = static_cast<const RasterMesh&>(*group.mesh);
    const Level& level =
        LevelFor(mesh.levels[group.chunk], item, fineness.moved_by * region_.TexelSize());
    Caster& caster = casters.emplace_back();
    caster.drawn = DrawnItem(render_list, i, level, {});
    for (int k = 0; k < 4; ++k) {
      float& m = caster.depth_row[k];
      m = k == 3 ? shadow_from_relative[14] : 0;
      for (std::size_t j = 0; j < 3; ++j) {
        m += shadow_from_relative[4 * j + 2] * caster.drawn.rows[j][k];
      }
    }
    caster.both_sides = !item.of_robot || group.double_sided;
    caster.around = region_.PartsOf(render_list, {i}).front();
  }
  return casters;
}

void SunShadow::DrawCasters(const RenderList& render_list, const std::vector<std::size_t>& items,
                            std::span<const ShadowRegion::Rectangle> copied,
                            std::vector<float>& map, base::ThreadTeam& team) {
  // There are more bands than threads, because some bands have more casters than others. The number
  // of bands is limited, because a caster is projected once for each band that it touches.
  constexpr int kBandsPerThread = 4, kMaxBands = 32;
  FrameBlock block{};
  region_.Describe({}, block);
  const std::vector<Caster> casters = CastersOf(render_list, items, block.shadow_from_relative);
  // Converts the map's x and y, from 0 to 1, to clip space, from -1 to 1.
  std::array<float, 16> clip = block.shadow_from_relative;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 2; ++row) {
      float& m = clip[4 * column + row];
      m = 2 * m - (column == 3 ? 1.0f : 0.0f);
    }
  }
  rasterisers_.resize(static_cast<std::size_t>(team.threads()));
  for (Rasteriser& rasteriser : rasterisers_) {
    rasteriser.Begin(kShadowSide, kShadowSide, 0.5, clip, Rasteriser::Rows::kUpwards);
  }
  const int bands = team.threads() == 1 ? 1 : std::min(kBandsPerThread * team.threads(), kMaxBands);
  const auto draw = [&](std::size_t begin, std::size_t end, std::size_t thread) {
    const auto row_of = [&](std::size_t i) { return kShadowSide * static_cast<int>(i) / bands; };
    const Band band{row_of(begin), row_of(end)};
    for (const ShadowRegion::Rectangle& part : copied) CopyStill(part, band);
    for (const Caster& caster : casters) {
      if (caster.around.max_y <= band.begin || caster.around.min_y >= band.end) continue;
      DrawCaster(caster, band, rasterisers_[thread], map);
    }
  };
  team.ParallelFor(static_cast<std::size_t>(bands), 1, draw);
}

void SunShadow::DrawCaster(const Caster& caster, const Band& band, Rasteriser& rasteriser,
                           std::vector<float>& map) {
  const RasterMesh& mesh = *caster.drawn.mesh;
  const DrawGroup& group = *caster.drawn.group;
  const float(&row)[4] = caster.depth_row;
  const auto* holes = group.blending == Blending::kAlphaMask
                          ? static_cast<const RasterTexture*>(group.base_colour.get())
                          : nullptr;
  rasteriser.ForEachTriangle(
      caster.drawn, 0, caster.both_sides, [&](const Triangle& t, const Box& box, bool) {
        // Draws only the rows in the band. The values at their texels do not depend on where the
        // box begins and ends.
        const Box part{box.x0, std::max(box.y0, band.begin), box.x1,
                       std::min(box.y1, band.end - 1)};
        if (part.y0 > part.y1) return;
        float a = 0, b = 0, c = 0;
        for (int i = 0; i < 3; ++i) {
          const std::uint32_t v = t.corner[i];
          const float z = row[0] * mesh.x[v] + row[1] * mesh.y[v] + row[2] * mesh.z[v] + row[3];
          a += t.a[i] * z, b += t.b[i] * z, c += t.c[i] * z;
        }
        // Moves the depth away from the sun by its change over a texel, so that no surface shades
        // itself.
        c -= 1.5f * std::max(std::abs(a), std::abs(b)) + 2e-7f;
        Scan<F8>(t, part, [&](const Pixels<F8>& pixels, I8 covered, F8) {
          const F8 dx = pixels.ColumnsFrom(t.x0), dy = pixels.RowsFrom(t.y0);
          if (holes != nullptr) covered &= Solid(t, mesh, *holes, dx, dy);
          const F8 z = Fma(Splat(a), dx, Splat(c) + Splat(b) * dy);
          float* at = &map[kFirst + pixels.In(kStride).of[0]];
          const F8 old = Load(at);
          Store(at, Select(covered & (z > old), z, old));
        });
      });
}

}  // namespace gsv::rendering::raster
