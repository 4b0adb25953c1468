#include "gsv/rendering/scene/lit_lamps.h"

#include <numbers>

#include "gsv/model/srgb.h"

namespace gsv::rendering {

std::vector<LitLamp> LitLamps(const world::Snapshot& snapshot) {
  std::vector<LitLamp> lit;
  if (snapshot.state.actuators == nullptr) return lit;
  for (const world::ActuatorStatePtr& state : *snapshot.state.actuators) {
    const auto* lamp = std::get_if<world::LampSetup>(&state->setup->kind);
    if (lamp == nullptr) continue;
    const int body = snapshot.layout->Find(state->robot);
    const world::Glow glow = world::GlowOf(state->order, *lamp);
    if (body >= 0 && glow.brightness > 0) lit.push_back({body, state->setup.get(), glow});
  }
  return lit;
}

model::Light LightOf(const LitLamp& lit, const world::Snapshot& snapshot) {
  constexpr double kInner = 0.8;  // of the cone: there it is as bright as in the middle
  const world::LampSetup& lamp = lit.lamp();
  model::Light light;
  light.kind =
      lamp.angle < 2 * std::numbers::pi ? model::Light::Kind::kSpot : model::Light::Kind::kPoint;
  light.world_from_light =
      world::LinkPose(snapshot, lit.body, lit.setup->link) * lit.setup->link_from_actuator;
  light.direction = {1, 0, 0};
  light.diffuse = {model::LinearFromSrgb(lit.glow.colour.r),
                   model::LinearFromSrgb(lit.glow.colour.g),
                   model::LinearFromSrgb(lit.glow.colour.b), 1};
  light.intensity = lamp.intensity * lit.glow.brightness;
  light.range = lamp.range;
  light.constant_attenuation = light.linear_attenuation = 0;
  light.quadratic_attenuation = 1;
  light.outer_angle = lamp.angle;
  light.inner_angle = kInner * lamp.angle;
  light.cast_shadows = false;
  return light;
}

}  // namespace gsv::rendering
