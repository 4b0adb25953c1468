#include "gsv/rendering/opengl/view_pass.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "gsv/rendering/opengl/gl.h"
#include "gsv/rendering/opengl/gpu_texture.h"
#include "gsv/rendering/opengl/shaders.h"

namespace gsv::rendering {
namespace {

using geometry::Vector3;

// The options of a surface program; each is a #define of its source.
enum Feature : unsigned {
  kBaseColourMap = 1,
  kNormalMap = 2,
  kMetallicRoughnessMap = 4,
  kEmissiveMap = 8,
  kAlphaMaskFeature = 16,
  kShadows = 32,
  kLamps = 64,
  kTransparentFeature = 128,
  kOcclusionMap = 256,
  kLightMap = 512,
};

constexpr std::pair<unsigned, const char*> kFeatureNames[] = {
    {kBaseColourMap, "BASE_COLOUR_MAP"},
    {kNormalMap, "NORMAL_MAP"},
    {kMetallicRoughnessMap, "METALLIC_ROUGHNESS_MAP"},
    {kEmissiveMap, "EMISSIVE_MAP"},
    {kAlphaMaskFeature, "CUT_OUT"},
    {kShadows, "SHADOWS"},
    {kLamps, "LAMPS"},
    {kTransparentFeature, "SEE_THROUGH"},
    {kOcclusionMap, "OCCLUSION_MAP"},
    {kLightMap, "LIGHT_MAP"},
};

unsigned FeaturesOf(const DrawGroup& group) {
  return (group.base_colour ? kBaseColourMap : 0u) | (group.normal ? kNormalMap : 0u) |
         (group.metallic_roughness ? kMetallicRoughnessMap : 0u) |
         (group.emissive ? kEmissiveMap : 0u) | (group.occlusion ? kOcclusionMap : 0u) |
         (group.light ? kLightMap : 0u) |
         (group.blending == Blending::kAlphaMask ? kAlphaMaskFeature : 0u) |
         (group.blending == Blending::kTransparent ? kTransparentFeature : 0u);
}

void BindMaps(const DrawGroup& group) {
  const auto bind = [](unsigned unit, const std::shared_ptr<const DrawTexture>& map) {
    if (map == nullptr) return;
    glBindTextureUnit(unit, static_cast<const GpuTexture&>(*map).texture.name());
  };
  bind(kBaseColourUnit, group.base_colour);
  bind(kNormalUnit, group.normal);
  bind(kMetallicRoughnessUnit, group.metallic_roughness);
  bind(kEmissiveUnit, group.emissive);
  bind(kOcclusionUnit, group.occlusion);
  bind(kLightUnit, group.light);
}

void SetFaces(const DrawGroup& group) {
  // Rows are ordered from top to bottom (see ClipFromRelative()), so counter-clockwise triangles
  // become clockwise.
  glFrontFace(group.mirrored ? GL_CCW : GL_CW);
  if (group.double_sided) {
    glDisable(GL_CULL_FACE);
  } else {
    glEnable(GL_CULL_FACE);
  }
  // A larger depth value is nearer to the camera.
  glPolygonOffset(group.ground ? -1.0f : 0.0f, group.ground ? -64.0f : 0.0f);
}

}  // namespace

ViewPass::ViewPass()
    : sky_(CreateProgram("", kSkyVertexShader, kSkyFragmentShader)), frame_(CreateBuffer()) {
  glNamedBufferStorage(frame_.name(), sizeof(FrameBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

unsigned ViewPass::ProgramFor(unsigned features) {
  const auto found = programs_.find(features);
  if (found != programs_.end()) return found->second.name();
  std::string defines;
  for (const auto& [feature, name] : kFeatureNames) {
    if (features & feature) defines += "#define " + std::string(name) + "\n";
  }
  GlProgram program = CreateProgram(defines, kSurfaceVertexShader, kSurfaceFragmentShader);
  return programs_.emplace(features, std::move(program)).first->second.name();
}

void ViewPass::FindVisible(const CameraView& view, const RenderList& render_list,
                           const ShadowMap* shadows) {
  // Smaller objects are not drawn, because they would only flicker.
  constexpr double kMinPixels = 0.3;
  const Frustum frustum = FrustumOf(view);
  const double smallest = kMinPixels / FocalLength(view.parameters);
  solid_.clear();
  transparent_.clear();
  for (std::size_t i = 0; i < render_list.items().size(); ++i) {
    const DrawItem& item = render_list.items()[i];
    const Vector3 centre = render_list.placed()[i].centre - view.world_from_camera.position;
    if (!frustum.MeetsSphere(centre, item.radius)) continue;
    const double distance = geometry::Norm(centre);
    if (item.radius < smallest * distance) continue;
    const bool is_transparent = render_list.groups()[item.group].blending == Blending::kTransparent;
    (is_transparent ? transparent_ : solid_)
        .push_back({item.group, distance, i,
                    shadows != nullptr &&
                        shadows->region().MayFallOn(render_list.placed()[i].centre, item.radius)});
  }
}

void ViewPass::StageSolid(const RenderList& render_list, const Vector3& origin) {
  std::sort(solid_.begin(), solid_.end(), [](const Seen& a, const Seen& b) {
    return std::tie(a.group, a.distance, a.item) < std::tie(b.group, b.distance, b.item);
  });
  solid_calls_.clear();
  for (const Seen& seen : solid_) {
    if (solid_calls_.empty() || solid_calls_.back().group != seen.group) {
      solid_calls_.push_back({seen.group, seen.distance, staged_.size(), 0, false});
    }
    ++solid_calls_.back().count;
    solid_calls_.back().shadowed |= seen.shadowed;
    staged_.push_back(
        InstanceOf(render_list.items()[seen.item], render_list.placed()[seen.item], origin));
  }
  std::stable_sort(solid_calls_.begin(), solid_calls_.end(), [&](const Call& a, const Call& b) {
    const bool a_ground = render_list.groups()[a.group].ground,
               b_ground = render_list.groups()[b.group].ground;
    return a_ground != b_ground ? b_ground : a.distance < b.distance;
  });
}

void ViewPass::StageTransparent(const RenderList& render_list, const Vector3& origin) {
  std::sort(transparent_.begin(), transparent_.end(), [](const Seen& a, const Seen& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.item < b.item;
  });
  transparent_calls_.clear();
  for (const Seen& seen : transparent_) {
    transparent_calls_.push_back({seen.group, seen.distance, staged_.size(), 1, seen.shadowed});
    staged_.push_back(
        InstanceOf(render_list.items()[seen.item], render_list.placed()[seen.item], origin));
  }
}

void ViewPass::Draw(const std::vector<Call>& calls, const RenderList& render_list, bool lamps,
                    const InstanceBuffer& instances) {
  for (const Call& call : calls) {
    const DrawGroup& group = render_list.groups()[call.group];
    glUseProgram(
        ProgramFor(FeaturesOf(group) | (call.shadowed ? kShadows : 0u) | (lamps ? kLamps : 0u)));
    BindMaps(group);
    SetFaces(group);
    instances.Draw(group, call.first, call.count);
  }
}

void ViewPass::Draw(const CameraView& view, const RenderList& render_list, const FrameBlock& block,
                    const ShadowMap* shadows, InstanceBuffer& instances) {
  staged_.clear();
  FindVisible(view, render_list, shadows);
  StageSolid(render_list, view.world_from_camera.position);
  StageTransparent(render_list, view.world_from_camera.position);
  instances.Upload(staged_);
  glNamedBufferSubData(frame_.name(), 0, sizeof block, &block);
  glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBlockBinding, frame_.name());

  const bool lamps = block.light_count[0] > 0;
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  glEnable(GL_POLYGON_OFFSET_FILL);
  Draw(solid_calls_, render_list, lamps, instances);

  glUseProgram(sky_.name());
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GEQUAL);
  glDrawArrays(GL_TRIANGLES, 0, 3);

  glEnable(GL_BLEND);
  // The alpha channel keeps the number of the opaque surface.
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  Draw(transparent_calls_, render_list, lamps, instances);
  glDisable(GL_BLEND);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDepthMask(GL_TRUE);
}

}  // namespace gsv::rendering
