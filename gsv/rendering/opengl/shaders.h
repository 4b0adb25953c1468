// The source code of the OpenGL shaders.
//
// Surfaces  Cook–Torrance with the GGX distribution (Walter et al. 2007), Hammon's approximation of
//           the height-correlated Smith term (2017), Schlick's Fresnel term; ambient reflections by
//           Karis' fit of the environment BRDF (2014).
// Tones     the compression of the Khronos PBR Neutral tone mapper (2024): colours up to 0.8 are
//           unchanged, highlights are compressed and lose colour.
#pragma once

#include <string>

namespace gsv::rendering {

// Compile these shaders with some of the following macros defined: BASE_COLOUR_MAP, NORMAL_MAP,
// METALLIC_ROUGHNESS_MAP, EMISSIVE_MAP, OCCLUSION_MAP, LIGHT_MAP, CUT_OUT, SEE_THROUGH, SHADOWS,
// LAMPS. With SEE_THROUGH, alpha is the opacity. Otherwise alpha is the number of the surface (0:
// the sky) for SmoothAliasedEdges().
extern const std::string kSurfaceVertexShader;
extern const std::string kSurfaceFragmentShader;

// If CUT_OUT is defined, the shader reads the base colour map.
extern const std::string kShadowVertexShader;
extern const std::string kShadowFragmentShader;

extern const std::string kSkyVertexShader;
extern const std::string kSkyFragmentShader;

// The following bindings are the same in all shaders.
// The binding point of the FrameBlock (frame_block.h).
inline constexpr unsigned kFrameBlockBinding = 0;
// The texture units of a material's maps and of the shadow map.
inline constexpr unsigned kBaseColourUnit = 0, kNormalUnit = 1, kMetallicRoughnessUnit = 2,
                          kEmissiveUnit = 3, kShadowUnit = 4, kOcclusionUnit = 5, kLightUnit = 6;

// The vertex attributes are the members of GpuMesh's vertices, followed by the members of
// InstanceData.
inline constexpr unsigned kPositionAttribute = 0, kNormalAttribute = 1, kUvAttribute = 2,
                          kSurfaceAttribute = 9, kFirstInstanceAttribute = 3;

}  // namespace gsv::rendering
