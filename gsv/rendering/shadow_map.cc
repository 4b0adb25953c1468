#include "gsv/rendering/shadow_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <epoxy/gl.h>

#include "gsv/rendering/shaders.h"

namespace gsv::rendering {
namespace {

using geometry::Dot;
using geometry::Vector3;

constexpr int kSide = 2048;  // texels
// Casters larger than this do not widen the map: one floor slab would blur every shadow on it.
constexpr double kMostRadius = 60;

GlTexture CreateDepthTexture() {
  GlTexture texture = CreateTexture2D();
  const unsigned name = texture.name();
  glTextureStorage2D(name, 1, GL_DEPTH_COMPONENT32F, kSide, kSide);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTextureParameteri(name, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  const float nothing_there[4] = {0, 0, 0, 0};
  glTextureParameterfv(name, GL_TEXTURE_BORDER_COLOR, nothing_there);
  return texture;
}

GlFramebuffer FrameOf(const GlTexture& depth) {
  GlFramebuffer frame = CreateFramebuffer();
  glNamedFramebufferTexture(frame.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
  glNamedFramebufferDrawBuffer(frame.name(), GL_NONE);
  glNamedFramebufferReadBuffer(frame.name(), GL_NONE);
  return frame;
}

// A lone robot does not get the whole map: its shadow would be finer than any picture, and slower.
constexpr double kLeastSide = 10;

// Outward to a multiple of a power of two that is about a sixteenth of the length.
void RoundOutward(double& min, double& max) {
  const double unit = std::exp2(std::ceil(std::log2((max - min) / 16)));
  min = unit * std::floor(min / unit);
  max = unit * std::ceil(max / unit);
}

}  // namespace

ShadowMap::ShadowMap()
    : still_(CreateDepthTexture()),
      moving_(CreateDepthTexture()),
      still_frame_(FrameOf(still_)),
      moving_frame_(FrameOf(moving_)),
      solid_(CreateProgram("", kShadowVertexShader, kShadowFragmentShader)),
      cut_out_(CreateProgram("#define CUT_OUT\n", kShadowVertexShader, kShadowFragmentShader)) {}

ShadowMap::Region ShadowMap::RegionOf(const DrawPlan& plan, const Vector3& to_sun) {
  const Vector3 helper = std::abs(to_sun.z) < 0.99 ? Vector3{0, 0, 1} : Vector3{1, 0, 0};
  const Vector3 right = geometry::Normalized(geometry::Cross(helper, to_sun));
  Region region{{right, geometry::Cross(to_sun, right), to_sun}, {}, {}};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double min[3] = {kInfinity, kInfinity, kInfinity}, max[3] = {-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t i = 0; i < plan.items().size(); ++i) {
    const DrawItem& item = plan.items()[i];
    if (!item.casts_shadow) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = Dot(region.axes[axis], plan.placed()[i].centre);
      // Along the light everything must be inside, or it would cast no shadow.
      const double radius = axis < 2 ? std::min(item.radius, kMostRadius) : item.radius;
      min[axis] = std::min(min[axis], at - radius);
      max[axis] = std::max(max[axis], at + radius);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (min[axis] > max[axis]) return region;
    const double missing = std::max(0.0, kLeastSide - (max[axis] - min[axis]));
    min[axis] -= 0.5 * missing;
    max[axis] += 0.5 * missing;
    RoundOutward(min[axis], max[axis]);
  }
  region.min = {min[0], min[1], min[2]};
  region.max = {max[0], max[1], max[2]};
  return region;
}

void ShadowMap::Draw(const DrawPlan& plan, std::uint64_t plan_id, const Vector3& to_sun,
                     const std::vector<CameraView>& views, InstanceBuffer& instances) {
  region_ = RegionOf(plan, to_sun);
  if (IsEmpty()) return;
  glViewport(0, 0, kSide, kSide);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-1.5f, -2.0f);
  const Drawn wanted{plan_id, plan.moved_count(), region_};
  if (drawn_ != wanted) {
    glBindFramebuffer(GL_FRAMEBUFFER, still_frame_.name());
    const float nothing_there = 0;
    glClearBufferfv(GL_DEPTH, 0, &nothing_there);
    DrawCasters(plan, StillCasters(plan), instances);
    drawn_ = wanted;
    moved_ = {{0, 0, kSide, kSide}};
  }
  for (const Rectangle& part : moved_) CopyStill(part);
  const std::vector<std::size_t> moving = MovingCasters(plan, views);
  moved_ = PartsOf(plan, moving);
  if (!moved_.empty()) {
    glBindFramebuffer(GL_FRAMEBUFFER, moving_frame_.name());
    DrawCasters(plan, moving, instances);
  }
  glDisable(GL_POLYGON_OFFSET_FILL);
}

std::vector<std::size_t> ShadowMap::StillCasters(const DrawPlan& plan) {
  std::vector<std::size_t> casters;
  for (std::size_t i = 0; i < plan.items().size(); ++i) {
    const DrawItem& item = plan.items()[i];
    if (item.casts_shadow && plan.IsStill(item.body)) casters.push_back(i);
  }
  return casters;
}

std::vector<std::size_t> ShadowMap::MovingCasters(const DrawPlan& plan,
                                                  const std::vector<CameraView>& views) const {
  // How far beside itself a surface is looked up: along its normal and by the filter.
  const double beside = 4 * TexelSize();
  // A shadow has no end; this is beyond all that any camera sees.
  const Vector3 shade = -1e7 * region_.axes[2];
  std::vector<std::pair<Vector3, Frustum>> seen;
  for (const CameraView& view : views) {
    seen.emplace_back(view.world_from_camera.position, FrustumOf(view));
  }
  std::vector<std::size_t> casters;
  for (std::size_t i = 0; i < plan.items().size(); ++i) {
    const DrawItem& item = plan.items()[i];
    if (!item.casts_shadow || plan.IsStill(item.body)) continue;
    const double radius = item.radius + beside;
    const Vector3 centre = plan.placed()[i].centre;
    const bool is_seen = std::any_of(seen.begin(), seen.end(), [&](const auto& camera) {
      return camera.second.MeetsMovingSphere(centre - camera.first, shade, radius);
    });
    if (is_seen) casters.push_back(i);
  }
  return casters;
}

std::vector<ShadowMap::Rectangle> ShadowMap::PartsOf(const DrawPlan& plan,
                                                     const std::vector<std::size_t>& items) const {
  // Past this many a copy of everything is cheaper.
  constexpr std::size_t kMostParts = 256;
  std::vector<Rectangle> parts;
  int last_body = -1;
  for (const std::size_t i : items) {
    const DrawItem& item = plan.items()[i];
    const auto texels = [&](int axis, double min, double max, double offset) {
      const double at = Dot(region_.axes[axis], plan.placed()[i].centre) + offset;
      return std::clamp((at - min) / (max - min), 0.0, 1.0) * kSide;
    };
    const double r = item.radius;
    const Rectangle around{
        std::max(0, static_cast<int>(texels(0, region_.min.x, region_.max.x, -r)) - 1),
        std::max(0, static_cast<int>(texels(1, region_.min.y, region_.max.y, -r)) - 1),
        std::min(kSide, static_cast<int>(texels(0, region_.min.x, region_.max.x, r)) + 2),
        std::min(kSide, static_cast<int>(texels(1, region_.min.y, region_.max.y, r)) + 2)};
    if (item.body != last_body) {
      parts.push_back(around);
      last_body = item.body;
    } else {
      Rectangle& part = parts.back();
      part = {std::min(part.min_x, around.min_x), std::min(part.min_y, around.min_y),
              std::max(part.max_x, around.max_x), std::max(part.max_y, around.max_y)};
    }
  }
  if (parts.size() > kMostParts) parts = {{0, 0, kSide, kSide}};
  return parts;
}

void ShadowMap::CopyStill(const Rectangle& part) {
  glCopyImageSubData(still_.name(), GL_TEXTURE_2D, 0, part.min_x, part.min_y, 0, moving_.name(),
                     GL_TEXTURE_2D, 0, part.min_x, part.min_y, 0, part.max_x - part.min_x,
                     part.max_y - part.min_y, 1);
}

void ShadowMap::DrawCasters(const DrawPlan& plan, const std::vector<std::size_t>& casters,
                            InstanceBuffer& instances) {
  std::vector<std::vector<std::size_t>> members(plan.groups().size());
  for (const std::size_t i : casters) {
    const DrawItem& item = plan.items()[i];
    // What is smaller than a texel hides none.
    if (item.radius > 0.5 * TexelSize()) members[item.group].push_back(i);
  }
  staged_.clear();
  for (const auto& items : members) {
    for (const std::size_t i : items) {
      staged_.push_back(InstanceOf(plan.items()[i], plan.placed()[i], {}));
    }
  }
  if (staged_.empty()) return;
  instances.Upload(staged_);
  FrameBlock block{};
  Describe({}, block);
  // The map holds [0, 1], clip space [-1, 1] by [-1, 1] by [0, 1].
  auto clip_from_world = block.shadow_from_relative;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 2; ++row) {
      float& m = clip_from_world[4 * column + row];
      m = 2 * m - (column == 3 ? 1.0f : 0.0f);
    }
  }
  for (const GlProgram* program : {&solid_, &cut_out_}) {
    glProgramUniformMatrix4fv(program->name(), 0, 1, GL_FALSE, clip_from_world.data());
  }
  std::size_t first = 0;
  for (std::size_t g = 0; g < members.size(); ++g) {
    if (members[g].empty()) continue;
    const DrawGroup& group = plan.groups()[g];
    const bool cut_out = group.blending == Blending::kCutOut;
    glUseProgram(cut_out ? cut_out_.name() : solid_.name());
    if (cut_out) glBindTextureUnit(kBaseColourUnit, group.base_colour->texture.name());
    instances.Draw(group, first, members[g].size());
    first += members[g].size();
  }
}

double ShadowMap::TexelSize() const {
  return std::max(region_.max.x - region_.min.x, region_.max.y - region_.min.y) / kSide;
}

bool ShadowMap::MayFallOn(const Vector3& centre, double radius) const {
  if (IsEmpty()) return false;
  const Vector3 at{Dot(region_.axes[0], centre), Dot(region_.axes[1], centre),
                   Dot(region_.axes[2], centre)};
  return at.x + radius > region_.min.x && at.x - radius < region_.max.x &&
         at.y + radius > region_.min.y && at.y - radius < region_.max.y &&
         at.z - radius < region_.max.z;
}

void ShadowMap::Bind() const {
  glBindTextureUnit(kShadowUnit, moved_.empty() ? still_.name() : moving_.name());
}

void ShadowMap::Describe(const Vector3& origin, FrameBlock& block) const {
  if (IsEmpty()) return;
  const double min[3] = {region_.min.x, region_.min.y, region_.min.z};
  const double max[3] = {region_.max.x, region_.max.y, region_.max.z};
  for (int axis = 0; axis < 3; ++axis) {
    const double k = 1 / (max[axis] - min[axis]);
    const Vector3 row = k * region_.axes[axis];
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
