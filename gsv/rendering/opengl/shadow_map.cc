#include "gsv/rendering/opengl/shadow_map.h"

#include "gsv/rendering/opengl/gl.h"
#include "gsv/rendering/opengl/gpu_texture.h"
#include "gsv/rendering/opengl/shaders.h"

namespace gsv::rendering {
namespace {

using geometry::Vector3;

constexpr int kSide = kShadowSide;
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

}  // namespace

ShadowMap::ShadowMap()
    : still_(CreateDepthTexture()),
      moving_(CreateDepthTexture()),
      still_frame_(FrameOf(still_)),
      moving_frame_(FrameOf(moving_)),
      solid_(CreateProgram("", kShadowVertexShader, kShadowFragmentShader)),
      alpha_mask_(CreateProgram("#define CUT_OUT\n", kShadowVertexShader, kShadowFragmentShader)) {}

void ShadowMap::Draw(const RenderList& render_list, std::uint64_t render_list_id,
                     const Vector3& to_sun, const std::vector<CameraView>& views,
                     InstanceBuffer& instances) {
  region_ = ShadowRegion(render_list, to_sun);
  if (region_.IsEmpty()) return;
  glViewport(0, 0, kSide, kSide);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-1.5f, -2.0f);
  const Drawn wanted{render_list_id, render_list.moved_count(), region_};
  if (drawn_ != wanted) {
    glBindFramebuffer(GL_FRAMEBUFFER, still_frame_.name());
    const float nothing_there = 0;
    glClearBufferfv(GL_DEPTH, 0, &nothing_there);
    DrawCasters(render_list, ShadowRegion::StillCasters(render_list), instances);
    drawn_ = wanted;
    moved_ = {{0, 0, kSide, kSide}};
  }
  for (const ShadowRegion::Rectangle& part : moved_) CopyStill(part);
  const std::vector<std::size_t> moving = region_.MovingCasters(render_list, views);
  moved_ = region_.PartsOf(render_list, moving);
  if (!moved_.empty()) {
    glBindFramebuffer(GL_FRAMEBUFFER, moving_frame_.name());
    DrawCasters(render_list, moving, instances);
  }
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void ShadowMap::CopyStill(const ShadowRegion::Rectangle& part) {
  glCopyImageSubData(still_.name(), GL_TEXTURE_2D, 0, part.min_x, part.min_y, 0, moving_.name(),
                     GL_TEXTURE_2D, 0, part.min_x, part.min_y, 0, part.max_x - part.min_x,
                     part.max_y - part.min_y, 1);
}

void ShadowMap::DrawCasters(const RenderList& render_list, const std::vector<std::size_t>& casters,
                            InstanceBuffer& instances) {
  std::vector<std::vector<std::size_t>> members(render_list.groups().size());
  for (const std::size_t i : casters) {
    const DrawItem& item = render_list.items()[i];
    // An object smaller than a texel casts no visible shadow.
    if (item.radius > 0.5 * region_.TexelSize()) members[item.group].push_back(i);
  }
  staged_.clear();
  for (const auto& items : members) {
    for (const std::size_t i : items) {
      staged_.push_back(InstanceOf(render_list.items()[i], render_list.placed()[i], {}));
    }
  }
  if (staged_.empty()) return;
  instances.Upload(staged_);
  FrameBlock block{};
  region_.Describe({}, block);
  // Converts the map's x and y, from 0 to 1, to clip space, from -1 to 1. The depth is not
  // converted: it is from 0 to 1 in both.
  auto clip_from_world = block.shadow_from_relative;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 2; ++row) {
      float& m = clip_from_world[4 * column + row];
      m = 2 * m - (column == 3 ? 1.0f : 0.0f);
    }
  }
  for (const GlProgram* program : {&solid_, &alpha_mask_}) {
    glProgramUniformMatrix4fv(program->name(), 0, 1, GL_FALSE, clip_from_world.data());
  }
  std::size_t first = 0;
  for (std::size_t g = 0; g < members.size(); ++g) {
    if (members[g].empty()) continue;
    const DrawGroup& group = render_list.groups()[g];
    const bool cut_out = group.blending == Blending::kAlphaMask;
    glUseProgram(cut_out ? alpha_mask_.name() : solid_.name());
    if (cut_out) {
      glBindTextureUnit(kBaseColourUnit,
                        static_cast<const GpuTexture&>(*group.base_colour).texture.name());
    }
    instances.Draw(group, first, members[g].size());
    first += members[g].size();
  }
}

void ShadowMap::Bind() const {
  glBindTextureUnit(kShadowUnit, moved_.empty() ? still_.name() : moving_.name());
}

}  // namespace gsv::rendering
