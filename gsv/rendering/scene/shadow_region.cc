#include "gsv/rendering/scene/shadow_region.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gsv::rendering {
namespace {

using geometry::Dot;
using geometry::Vector3;

// A caster with a larger radius does not make the region larger. Otherwise, one large floor slab
// would blur every shadow.
constexpr double kMaxRadius = 60;

// The minimum side length of a shadow region, m. In a smaller region, the shadow of a single robot
// would be finer than needed and slower to render.
constexpr double kMinSide = 10;

// Rounds both ends of a range outwards to multiples of a unit. The unit is the smallest power of
// two that is at least a sixteenth of the range's length.
void RoundOutward(double& min, double& max) {
  const double unit = std::exp2(std::ceil(std::log2((max - min) / 16)));
  min = unit * std::floor(min / unit);
  max = unit * std::ceil(max / unit);
}

}  // namespace

ShadowRegion::ShadowRegion(const RenderList& render_list, const Vector3& to_sun) {
  const Vector3 helper = std::abs(to_sun.z) < 0.99 ? Vector3{0, 0, 1} : Vector3{1, 0, 0};
  const Vector3 right = geometry::Normalized(geometry::Cross(helper, to_sun));
  axes_ = {right, geometry::Cross(to_sun, right), to_sun};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double min[3] = {kInfinity, kInfinity, kInfinity}, max[3] = {-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t i = 0; i < render_list.items().size(); ++i) {
    const DrawItem& item = render_list.items()[i];
    if (!item.casts_shadow) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = Dot(axes_[axis], render_list.placed()[i].centre);
      // Axis 2 is the direction of the light. Along it, every caster must be completely inside the
      // region. Otherwise, the caster would have no shadow.
      const double radius = axis < 2 ? std::min(item.radius, kMaxRadius) : item.radius;
      min[axis] = std::min(min[axis], at - radius);
      max[axis] = std::max(max[axis], at + radius);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (min[axis] > max[axis]) return;
    const double missing = std::max(0.0, kMinSide - (max[axis] - min[axis]));
    min[axis] -= 0.5 * missing;
    max[axis] += 0.5 * missing;
    RoundOutward(min[axis], max[axis]);
  }
  min_ = {min[0], min[1], min[2]};
  max_ = {max[0], max[1], max[2]};
}

double ShadowRegion::TexelSize() const {
  return std::max(max_.x - min_.x, max_.y - min_.y) / kShadowSide;
}

bool ShadowRegion::MayFallOn(const Vector3& centre, double radius) const {
  if (IsEmpty()) return false;
  const Vector3 at{Dot(axes_[0], centre), Dot(axes_[1], centre), Dot(axes_[2], centre)};
  return at.x + radius > min_.x && at.x - radius < max_.x && at.y + radius > min_.y &&
         at.y - radius < max_.y && at.z - radius < max_.z;
}

std::vector<std::size_t> ShadowRegion::StillCasters(const RenderList& render_list) {
  std::vector<std::size_t> casters;
  for (std::size_t i = 0; i < render_list.items().size(); ++i) {
    const DrawItem& item = render_list.items()[i];
    if (item.casts_shadow && render_list.IsStill(item.body)) casters.push_back(i);
  }
  return casters;
}

std::vector<std::size_t> ShadowRegion::MovingCasters(const RenderList& render_list,
                                                     const std::vector<CameraView>& views) const {
  // The maximum distance between a point and the texels that are read for its shadow. The shader
  // shifts the point along its normal and reads several neighbouring texels there.
  const double beside = 4 * TexelSize();
  // Shadows are infinitely long; this length is beyond the view of every camera.
  const Vector3 shade = -1e7 * axes_[2];
  std::vector<std::pair<Vector3, Frustum>> seen;
  seen.reserve(views.size());
  for (const CameraView& view : views) {
    seen.emplace_back(view.world_from_camera.position, FrustumOf(view));
  }
  std::vector<std::size_t> casters;
  for (std::size_t i = 0; i < render_list.items().size(); ++i) {
    const DrawItem& item = render_list.items()[i];
    if (!item.casts_shadow || render_list.IsStill(item.body)) continue;
    const double radius = item.radius + beside;
    const Vector3 centre = render_list.placed()[i].centre;
    const bool is_seen = std::any_of(seen.begin(), seen.end(), [&](const auto& camera) {
      return camera.second.MeetsMovingSphere(centre - camera.first, shade, radius);
    });
    if (is_seen) casters.push_back(i);
  }
  return casters;
}

std::vector<ShadowRegion::Rectangle> ShadowRegion::PartsOf(
    const RenderList& render_list, const std::vector<std::size_t>& items) const {
  // If more parts than this have changed, copying the whole map is cheaper.
  constexpr std::size_t kMaxParts = 256;
  std::vector<Rectangle> parts;
  int last_body = -1;
  for (const std::size_t i : items) {
    const DrawItem& item = render_list.items()[i];
    const auto texels = [&](int axis, double min, double max, double offset) {
      const double at = Dot(axes_[axis], render_list.placed()[i].centre) + offset;
      return std::clamp((at - min) / (max - min), 0.0, 1.0) * kShadowSide;
    };
    const double r = item.radius;
    const Rectangle around{
        std::max(0, static_cast<int>(texels(0, min_.x, max_.x, -r)) - 1),
        std::max(0, static_cast<int>(texels(1, min_.y, max_.y, -r)) - 1),
        std::min(kShadowSide, static_cast<int>(texels(0, min_.x, max_.x, r)) + 2),
        std::min(kShadowSide, static_cast<int>(texels(1, min_.y, max_.y, r)) + 2)};
    if (item.body != last_body) {
      parts.push_back(around);
      last_body = item.body;
    } else {
      Rectangle& part = parts.back();
      part = {std::min(part.min_x, around.min_x), std::min(part.min_y, around.min_y),
              std::max(part.max_x, around.max_x), std::max(part.max_y, around.max_y)};
    }
  }
  if (parts.size() > kMaxParts) parts = {{0, 0, kShadowSide, kShadowSide}};
  return parts;
}

void ShadowRegion::Describe(const Vector3& origin, FrameBlock& block) const {
  if (IsEmpty()) return;
  const double min[3] = {min_.x, min_.y, min_.z};
  const double max[3] = {max_.x, max_.y, max_.z};
  for (int axis = 0; axis < 3; ++axis) {
    const double k = 1 / (max[axis] - min[axis]);
    const Vector3 row = k * axes_[axis];
    block.shadow_from_relative[axis] = static_cast<float>(row.x);
    block.shadow_from_relative[4 + axis] = static_cast<float>(row.y);
    block.shadow_from_relative[8 + axis] = static_cast<float>(row.z);
    block.shadow_from_relative[12 + axis] = static_cast<float>(Dot(row, origin) - k * min[axis]);
  }
  for (int column = 0; column < 4; ++column) {
    block.shadow_from_relative[4 * column + 3] = column == 3 ? 1.0f : 0.0f;
  }
  block.to_sun[3] = static_cast<float>(TexelSize());
}

}  // namespace gsv::rendering
