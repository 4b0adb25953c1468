#include "gsv/rendering/scene/lit_lamps.h"

#include <numbers>

#include "gsv/model/srgb.h"

namespace gsv::rendering {

std::vector<LitLamp> LitLamps(const world::Snapshot& snapshot) {
  std::vector<LitLamp> lit;
  if (snapshot.state.devices == nullptr) return lit;
  for (const world::DeviceStatePtr& state : *snapshot.state.devices) {
    const auto glow = state->glow();
    const int body = glow ? snapshot.layout->Find(state->robot()) : -1;
    if (body >= 0) lit.push_back({body, &state->mount(), *glow});
  }
  return lit;
}

model::Light LightOf(const LitLamp& lit, const world::Snapshot& snapshot) {
  // the part of the cone in which the lamp is as bright as in the middle
  constexpr double kInner = 0.8;
  const world::Glow& glow = lit.glow;
  model::Light light;
  light.kind =
      glow.angle < 2 * std::numbers::pi ? model::Light::Kind::kSpot : model::Light::Kind::kPoint;
  light.world_from_light =
      world::LinkPose(snapshot, lit.body, lit.mount->link) * lit.mount->link_from_device;
  light.direction = {1, 0, 0};
  light.diffuse = {model::LinearFromSrgb(glow.colour.r), model::LinearFromSrgb(glow.colour.g),
                   model::LinearFromSrgb(glow.colour.b), 1};
  light.intensity = glow.intensity * glow.brightness;
  light.range = glow.range;
  light.constant_attenuation = light.linear_attenuation = 0;
  light.quadratic_attenuation = 1;
  light.outer_angle = glow.angle;
  light.inner_angle = kInner * glow.angle;
  light.cast_shadows = false;
  return light;
}

}  // namespace gsv::rendering
