#include "gsv/rendering/scene/frame_block.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gsv/model/srgb.h"
#include "gsv/rendering/scene/lit_lamps.h"

namespace gsv::rendering {
namespace {

using geometry::Vector3;
using Rgb = std::array<double, 3>;

// The colours of lights are linear amounts, without gamma: 0.8 means four fifths of the light of 1.
Rgb LightColour(const model::Light& light) {
  const double k = std::max(0.0, light.intensity);
  return {k * light.diffuse.r, k * light.diffuse.g, k * light.diffuse.b};
}

double Brightness(const Rgb& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

Float4 AsFloat4(const Vector3& v, double w = 0) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
          static_cast<float>(w)};
}

Float4 AsFloat4(const Rgb& c, double k = 1, double w = 0) {
  return {static_cast<float>(k * c[0]), static_cast<float>(k * c[1]), static_cast<float>(k * c[2]),
          static_cast<float>(w)};
}

Rgb Linear(const model::Colour& c) {
  return {model::LinearFromSrgb(c.r), model::LinearFromSrgb(c.g), model::LinearFromSrgb(c.b)};
}

Rgb Mix(const Rgb& a, const Rgb& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

// Limits ambient light to a useful range. Some worlds have almost no ambient light, because they
// were made for a simulator that adds its own. Without the minimum, these worlds
// would be dark. Other worlds have so much ambient light that shadows would be invisible without
// the maximum.
Rgb Ambient(const model::Colour& asked) {
  constexpr double kMin = 0.3, kMax = 0.45;
  const Rgb c{asked.r, asked.g, asked.b};
  const double brightness = Brightness(c);
  if (brightness > kMax) return Mix({0, 0, 0}, c, kMax / brightness);
  return Mix({kMin, kMin, kMin}, c, std::min(1.0, brightness / kMin));
}

}  // namespace

Lighting::Lighting(const model::WorldDescription& description) {
  // The brightest directional light is the sun, which casts the shadows.
  const model::Light* sun = nullptr;
  for (const model::Light& light : description.lights) {
    if (light.kind == model::Light::Kind::kDirectional &&
        (sun == nullptr || Brightness(LightColour(light)) > Brightness(LightColour(*sun)))) {
      sun = &light;
    }
  }
  if (sun != nullptr) {
    to_sun_ = -(sun->world_from_light.orientation * sun->direction);
    sun_colour_ = LightColour(*sun);
    shadows_ = description.scene.shadows && sun->cast_shadows;
  } else if (description.lights.empty()) {
    sun_colour_ = {0.9, 0.88, 0.84};
    shadows_ = description.scene.shadows;
  } else {
    shadows_ = false;
  }
  to_sun_ = geometry::Normalized(to_sun_);
  for (const model::Light& light : description.lights) {
    if (&light != sun) AddLamp(light);
  }
  own_lamp_count_ = lamps_.size();
  const Rgb ambient = Ambient(description.scene.ambient);
  ambient_above_ = AsFloat4(Mix(ambient, {0.9 * ambient[0], ambient[1], 1.15 * ambient[2]}, 0.5));
  ambient_below_ = AsFloat4(ambient, 0.55);
  const Rgb background = Linear(description.scene.background);
  if (description.scene.sky) {
    zenith_ = AsFloat4(Rgb{0.12, 0.28, 0.62});
    horizon_ = AsFloat4(Rgb{0.62, 0.74, 0.86});
    nadir_ = AsFloat4(Rgb{0.30, 0.29, 0.27});
  } else {
    zenith_ = AsFloat4(background, 0.8);
    horizon_ = AsFloat4(Mix(background, {1, 1, 1}, 0.08));
    nadir_ = AsFloat4(background, 0.7);
  }
}

void Lighting::TakeLamps(const world::Snapshot& snapshot) {
  lamps_.resize(own_lamp_count_);
  for (const LitLamp& lit : LitLamps(snapshot)) {
    if (lit.glow.range > 0) AddLamp(LightOf(lit, snapshot));
  }
}

void Lighting::AddLamp(const model::Light& light) {
  const bool directional = light.kind == model::Light::Kind::kDirectional;
  const bool spot = light.kind == model::Light::Kind::kSpot;
  const Vector3 direction =
      geometry::Normalized(light.world_from_light.orientation * light.direction);
  Lamp lamp;
  lamp.position = light.world_from_light.position;
  lamp.range = directional ? std::numeric_limits<double>::infinity() : std::max(light.range, 0.01);
  const double outer = spot ? std::cos(0.5 * light.outer_angle) : -2;
  // The edge of the cone has a minimum width, so that it is not jagged in the image.
  const double inner = spot ? std::max(std::cos(0.5 * light.inner_angle), outer + 1e-3) : -1;
  lamp.block = {{0, 0, 0, 0},
                AsFloat4(direction, outer),
                AsFloat4(LightColour(light), 1, 1 / (inner - outer)),
                AsFloat4(Vector3{light.constant_attenuation, light.linear_attenuation,
                                 light.quadratic_attenuation},
                         1 / (lamp.range * lamp.range))};
  lamps_.push_back(lamp);
}

FrameBlock Lighting::BlockFor(const CameraView& view) const {
  FrameBlock block{};
  block.clip_from_relative = ClipFromRelative(view);
  block.to_sun = AsFloat4(to_sun_);
  block.sun_colour = AsFloat4(sun_colour_);
  block.ambient_above = ambient_above_, block.ambient_below = ambient_below_;
  block.zenith = zenith_, block.horizon = horizon_, block.nadir = nadir_;

  const geometry::Pose& pose = view.world_from_camera;
  const double f = FocalLength(view.parameters);
  block.view_forward = AsFloat4(pose.orientation * Vector3{1, 0, 0});
  block.view_right = AsFloat4(pose.orientation * Vector3{0, -0.5 * view.parameters.width / f, 0});
  block.view_down = AsFloat4(pose.orientation * Vector3{0, 0, -0.5 * view.parameters.height / f});

  // If too many lamps light a part of the image, selects the lamps whose lit regions are nearest to
  // the camera.
  const Frustum frustum = FrustumOf(view);
  std::vector<std::pair<double, const Lamp*>> near;
  for (const Lamp& lamp : lamps_) {
    const Vector3 relative = lamp.position - pose.position;
    if (std::isinf(lamp.range)) {
      near.emplace_back(-std::numeric_limits<double>::infinity(), &lamp);
    } else if (frustum.MeetsSphere(relative, lamp.range)) {
      near.emplace_back(geometry::Norm(relative) - lamp.range, &lamp);
    }
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const std::size_t count = std::min<std::size_t>(near.size(), kMaxLights);
  block.light_count[0] = static_cast<std::int32_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Lamp& lamp = *near[i].second;
    block.lights[i] = lamp.block;
    block.lights[i].position_range =
        AsFloat4(lamp.position - pose.position, std::isinf(lamp.range) ? 0 : lamp.range);
  }
  return block;
}

}  // namespace gsv::rendering
