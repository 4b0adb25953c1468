#include "gsv/rendering/opengl/shaders.h"

namespace gsv::rendering {
namespace {

// The layout must be the layout of FrameBlock in frame_block.h.
const std::string kFrame = R"(
struct Light { vec4 position_range, direction_outer, colour_inner, attenuation; };
layout(std140, binding = 0) uniform Frame {
  mat4 clip_from_relative;
  mat4 shadow_from_relative;
  vec4 to_sun;
  vec4 sun_colour;
  vec4 ambient_above, ambient_below;
  vec4 zenith, horizon, nadir;
  vec4 view_forward, view_right, view_down;
  ivec4 light_count;
  Light lights[8];
};
)";

// The colour of the sky in a direction, as a function of the sine of the direction's elevation.
const std::string kSky = R"(
vec3 Sky(float height) {
  float up = clamp(height, 0.0, 1.0);
  float down = clamp(-8.0 * height, 0.0, 1.0);
  float high = 1.0 - (1.0 - up) * (1.0 - up);
  return mix(mix(horizon.rgb, zenith.rgb, high), nadir.rgb, down);
}
)";

// Encodes linear light as sRGB, approximated by square roots, within half a step of eight bits
// (Taylor, chilliant.blogspot.com, 2012). The shader encodes each pixel once. The framebuffer would
// encode each sample of a pixel.
const std::string kEncoding = R"(
vec3 Encode(vec3 linear) {
  vec3 s1 = sqrt(max(linear, vec3(0.0))), s2 = sqrt(s1), s3 = sqrt(s2);
  return 0.662002687 * s1 + 0.684122060 * s2 - 0.323583601 * s3 - 0.0225411470 * linear;
}
)";

// Decodes sRGB with a cubic, within a step of eight bits (same source). Textures are stored
// encoded, and the shader decodes the sampled value once. A texture format that is decoded by the
// card would decode all eight texels of a sample.
const std::string kDecoding = R"(
vec3 Decode(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }
)";

const std::string kToneMapping = R"(
vec3 ToneMap(vec3 colour) {
  const float start = 0.8, desaturation = 0.15;
  float peak = max(colour.r, max(colour.g, colour.b));
  if (peak < start) return colour;
  float d = 1.0 - start;
  float new_peak = 1.0 - d * d / (peak + d - start);
  colour *= new_peak / peak;
  float g = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
  return mix(colour, vec3(new_peak), g);
}
)";

const std::string kVertexInputs = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 row0;  // relative_from_mesh
layout(location = 4) in vec4 row1;
layout(location = 5) in vec4 row2;
)";

}  // namespace

const std::string kSurfaceVertexShader = kFrame + kVertexInputs + R"(
layout(location = 6) in vec4 base_colour;
layout(location = 7) in vec4 emissive_metalness;
layout(location = 8) in vec2 roughness_surface;
layout(location = 9) in float mesh_surface;
out vec3 v_position;
out vec3 v_normal;
out vec2 v_uv;
flat out vec4 v_base_colour;
flat out vec4 v_emissive_metalness;
flat out vec2 v_roughness_surface;
invariant gl_Position;
void main() {
  vec4 p = vec4(position, 1.0);
  v_position = vec3(dot(row0, p), dot(row1, p), dot(row2, p));
  // Normals are transformed by the cofactors of rotation and scale. If the scale mirrors the mesh,
  // the cofactors turn normals inward, and handedness turns them back.
  vec3 c0 = cross(row1.xyz, row2.xyz), c1 = cross(row2.xyz, row0.xyz), c2 = cross(row0.xyz, row1.xyz);
  float handedness = dot(row0.xyz, c0) < 0.0 ? -1.0 : 1.0;
  v_normal = handedness * vec3(dot(c0, normal), dot(c1, normal), dot(c2, normal));
  v_uv = uv;
  v_base_colour = base_colour;
  v_emissive_metalness = emissive_metalness;
  // Adjacent surfaces, and the same surface of two objects, get different 8-bit numbers.
  float surface = mod(97.0 * mesh_surface + 57.0 * roughness_surface.y, 255.0) + 1.0;
  v_roughness_surface = vec2(roughness_surface.x, surface / 255.0);
  gl_Position = clip_from_relative * vec4(v_position, 1.0);
}
)";

const std::string kSurfaceFragmentShader = kFrame + kEncoding + kDecoding + kToneMapping + R"(
layout(binding = 0) uniform sampler2D base_colour_map;
layout(binding = 1) uniform sampler2D normal_map;
layout(binding = 2) uniform sampler2D metallic_roughness_map;
layout(binding = 3) uniform sampler2D emissive_map;
layout(binding = 4) uniform sampler2DShadow shadow_map;
layout(binding = 5) uniform sampler2D occlusion_map;
layout(binding = 6) uniform sampler2D light_map;
in vec3 v_position;
in vec3 v_normal;
in vec2 v_uv;
flat in vec4 v_base_colour;
flat in vec4 v_emissive_metalness;
flat in vec2 v_roughness_surface;
layout(location = 0) out vec4 colour;

struct Surface {
  vec3 normal, diffuse, specular;  // specular: reflectance at normal incidence
  float alpha, alpha2;             // GGX's alpha, which is roughness squared, and its square
  float n_dot_v;
};

// The light that `surface` reflects towards the camera, for a source of strength 1 in the
// direction `to_light`.
vec3 Reflect(Surface surface, vec3 to_light, vec3 to_view, float n_dot_l) {
  vec3 h = normalize(to_light + to_view);
  float n_dot_h = clamp(dot(surface.normal, h), 0.0, 1.0);
  float v_dot_h = clamp(dot(to_view, h), 0.0, 1.0);
  float m = 1.0 - v_dot_h, m2 = m * m;
  vec3 fresnel = surface.specular + (1.0 - surface.specular) * (m2 * m2 * m);
  float d = n_dot_h * n_dot_h * (surface.alpha2 - 1.0) + 1.0;
  // The terms are the distribution times pi, alpha2 / d², and the visibility, 0.5 / v.
  float v = max(mix(2.0 * n_dot_l * surface.n_dot_v, n_dot_l + surface.n_dot_v, surface.alpha), 1e-4);
  float gloss = 0.5 * surface.alpha2 / (d * d * v);
  return (surface.diffuse * (1.0 - fresnel) + fresnel * min(gloss, 8.0)) * n_dot_l;
}

vec3 Ambient(Surface surface, vec3 to_view, float roughness) {
  vec3 around = mix(ambient_below.rgb, ambient_above.rgb, 0.5 + 0.5 * surface.normal.z);
  // Surfaces that face the sun get more indirect light, so that shapes stay visible in shadow.
  around *= 0.9 + 0.2 * dot(surface.normal, to_sun.xyz);
  vec3 r = reflect(-to_view, surface.normal);
  vec3 mirrored = mix(mix(ambient_below.rgb, ambient_above.rgb, smoothstep(-0.25, 0.25, r.z)), around, roughness);
  vec4 fit = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
  float a = min(fit.x * fit.x, exp2(-9.28 * surface.n_dot_v)) * fit.x + fit.y;
  vec2 scale_bias = vec2(-1.04, 1.04) * a + fit.zw;
  return around * surface.diffuse + mirrored * (surface.specular * scale_bias.x + scale_bias.y);
}

#ifdef SHADOWS
float SunVisible(vec3 normal, float n_dot_l) {
  vec3 p = v_position + normal * (to_sun.w * (1.5 - n_dot_l));
  vec3 s = (shadow_from_relative * vec4(p, 1.0)).xyz;
  s.z = max(s.z, 0.0);  // the cleared map has depth 0, so no point may be below 0
  const float texel = 1.0 / 2048.0;  // kSide of shadow_map.cc
  return 0.5 * (texture(shadow_map, vec3(s.xy + texel * vec2(-0.6, -0.3), s.z)) +
                texture(shadow_map, vec3(s.xy + texel * vec2(0.6, 0.3), s.z)));
}
#endif

#ifdef LAMPS
vec3 Lamp(Light light, Surface surface, vec3 to_view) {
  vec3 to_light = -light.direction_outer.xyz;
  float strength = 1.0;
  if (light.position_range.w > 0.0) {
    vec3 offset = light.position_range.xyz - v_position;
    float distance2 = max(dot(offset, offset), 1e-8), near = inversesqrt(distance2);
    float distance = distance2 * near;
    to_light = offset * near;
    float x2 = distance2 * light.attenuation.w;
    float window = clamp(1.0 - x2 * x2, 0.0, 1.0);
    strength = window * window /
        max(light.attenuation.x + distance * (light.attenuation.y + distance * light.attenuation.z), 0.05);
    float cone = dot(-to_light, light.direction_outer.xyz);
    strength *= clamp((cone - light.direction_outer.w) * light.colour_inner.w, 0.0, 1.0);
  }
  float n_dot_l = clamp(dot(surface.normal, to_light), 0.0, 1.0);
  return light.colour_inner.rgb * strength * Reflect(surface, to_light, to_view, n_dot_l);
}
#endif

#ifdef NORMAL_MAP
// The frame along the texture's axes follows from the change of position and uv across the screen
// (Schüler, "Followup: normal mapping without precomputed tangents", 2013). v runs downwards.
vec3 Bumped(vec3 n) {
  vec3 bump = texture(normal_map, v_uv).xyz * 2.0 - 1.0;
  vec3 p_x = dFdx(v_position), p_y = dFdy(v_position);
  vec2 uv_x = dFdx(v_uv), uv_y = dFdy(v_uv);
  vec3 q_x = cross(n, p_x), q_y = cross(p_y, n);
  vec3 t = q_y * uv_x.x + q_x * uv_y.x, b = q_y * uv_x.y + q_x * uv_y.y;
  float longest = max(dot(t, t), dot(b, b));
  if (longest <= 0.0) return n;
  float k = inversesqrt(longest) * (dot(cross(p_x, p_y), n) < 0.0 ? -1.0 : 1.0);
  return normalize(t * (k * bump.x) - b * (k * bump.y) + n * bump.z);
}
#endif

void main() {
  vec4 base = v_base_colour;
#ifdef BASE_COLOUR_MAP
  vec4 base_texel = texture(base_colour_map, v_uv);
  base *= vec4(Decode(base_texel.rgb), base_texel.a);
#endif
#ifdef CUT_OUT
  if (base.a < 0.5) discard;
#endif
  float metalness = v_emissive_metalness.w, roughness = v_roughness_surface.x;
#ifdef METALLIC_ROUGHNESS_MAP
  vec4 mr = texture(metallic_roughness_map, v_uv);
  metalness *= mr.b;
  roughness = max(roughness * mr.g, 0.05);
#endif
  vec3 emissive = v_emissive_metalness.rgb;
#ifdef EMISSIVE_MAP
  emissive *= Decode(texture(emissive_map, v_uv).rgb);
#endif
  vec3 n = normalize(v_normal);
  if (!gl_FrontFacing) n = -n;
  vec3 face_normal = n;
#ifdef NORMAL_MAP
  n = Bumped(n);
#endif
  vec3 to_view = normalize(-v_position);
  Surface surface;
  surface.normal = n;
  surface.diffuse = base.rgb * (1.0 - metalness);
  surface.specular = mix(vec3(0.04), base.rgb, metalness);
  surface.alpha = roughness * roughness;
  surface.alpha2 = surface.alpha * surface.alpha;
  surface.n_dot_v = clamp(dot(n, to_view), 1e-3, 1.0);

  float n_dot_l = clamp(dot(n, to_sun.xyz), 0.0, 1.0);
  vec3 sun = sun_colour.rgb * Reflect(surface, to_sun.xyz, to_view, n_dot_l);
#ifdef SHADOWS
  sun *= SunVisible(face_normal, n_dot_l);
#endif
  vec3 ambient = Ambient(surface, to_view, roughness);
#ifdef LIGHT_MAP
  ambient += Decode(texture(light_map, v_uv).rgb) * surface.diffuse;
#endif
#ifdef OCCLUSION_MAP
  ambient *= texture(occlusion_map, v_uv).r;
#endif
  vec3 light = emissive + sun + ambient;
#ifdef LAMPS
  for (int i = 0; i < light_count.x; ++i) light += Lamp(lights[i], surface, to_view);
#endif
#ifdef SEE_THROUGH
  colour = vec4(Encode(ToneMap(light)), base.a);
#else
  colour = vec4(Encode(ToneMap(light)), v_roughness_surface.y);
#endif
}
)";

const std::string kShadowVertexShader = kVertexInputs + R"(
layout(location = 0) uniform mat4 clip_from_world;
out vec2 v_uv;
void main() {
  vec4 p = vec4(position, 1.0);
  v_uv = uv;
  gl_Position = clip_from_world * vec4(dot(row0, p), dot(row1, p), dot(row2, p), 1.0);
}
)";

const std::string kShadowFragmentShader = R"(
layout(binding = 0) uniform sampler2D base_colour_map;
in vec2 v_uv;
void main() {
#ifdef CUT_OUT
  if (texture(base_colour_map, v_uv).a < 0.5) discard;
#endif
}
)";

const std::string kSkyVertexShader = kFrame + R"(
out vec3 v_direction;
void main() {
  // The sky is one triangle over the whole image, infinitely far away.
  vec2 p = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  v_direction = view_forward.xyz + p.x * view_right.xyz + p.y * view_down.xyz;
  gl_Position = vec4(p, 0.0, 1.0);
}
)";

const std::string kSkyFragmentShader = kFrame + kSky + kEncoding + R"(
in vec3 v_direction;
layout(location = 0) out vec4 colour;
void main() { colour = vec4(Encode(Sky(normalize(v_direction).z)), 0.0); }
)";

}  // namespace gsv::rendering
