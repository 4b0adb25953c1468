#include "gsv/world/actuators.h"

#include <algorithm>
#include <utility>

namespace gsv::world {
namespace {

using Key = std::pair<std::string_view, std::string_view>;

Key KeyOf(const ActuatorStatePtr& state) { return {state->robot, state->actuator}; }

}  // namespace

const ActuatorState* FindActuator(const Actuators* actuators, std::string_view robot,
                                  std::string_view actuator) {
  if (actuators == nullptr) return nullptr;
  const Key wanted(robot, actuator);
  const auto at =
      std::lower_bound(actuators->begin(), actuators->end(), wanted,
                       [](const ActuatorStatePtr& a, const Key& key) { return KeyOf(a) < key; });
  return at != actuators->end() && KeyOf(*at) == wanted ? at->get() : nullptr;
}

void AddToHash(const Actuators& actuators, base::Hash& hash) {
  for (const ActuatorStatePtr& state : actuators) {
    hash.Add(std::string_view(state->robot));
    hash.Add(std::string_view(state->actuator));
    hash.Add(static_cast<std::int64_t>(state->since.count()));
    hash.Add(static_cast<std::uint64_t>(state->order.values.size()));
    for (const double value : state->order.values) hash.Add(value);
    hash.Add(std::string_view(state->order.word));
    hash.Add(state->opening_before);
    hash.Add(std::string_view(state->grip.held));
    const geometry::Pose& pose = state->grip.link_from_held;
    const geometry::Quaternion& q = pose.orientation;
    for (const double value : {pose.position.x, pose.position.y, pose.position.z, q.w, q.x, q.y,
                               q.z, state->grip.width}) {
      hash.Add(value);
    }
  }
}

Glow GlowOf(const ActuatorOrder& order, const LampSetup& lamp) {
  const std::vector<double>& v = order.values;
  Glow glow{v.empty() ? 0 : v[0], lamp.colour};
  if (v.size() == 4) glow.colour = {v[1], v[2], v[3], 1};
  return glow;
}

std::optional<Sound> SoundOf(const ActuatorState& speaker, base::SimTime now) {
  const std::vector<double>& v = speaker.order.values;
  if (v.size() != 3) return std::nullopt;
  const double elapsed = base::ToSeconds(now - speaker.since);
  if (elapsed >= v[1] || v[2] <= 0) return std::nullopt;
  return Sound{speaker.order.word, v[0], v[2], elapsed, v[1] - elapsed};
}

bool IsToldToOpen(const ActuatorState& gripper) {
  return gripper.order.values.empty() || gripper.order.values[0] > 0.5;
}

double OpeningOf(const ActuatorState& gripper, base::SimTime now) {
  const auto& setup = std::get<GripperSetup>(gripper.setup->kind);
  const double wanted = IsToldToOpen(gripper) ? setup.opening : 0;
  const double way = setup.opening * base::ToSeconds(now - gripper.since) / setup.closing_time;
  const double opening =
      gripper.opening_before + std::clamp(wanted - gripper.opening_before, -way, way);
  return gripper.grip.held.empty() ? opening : std::max(opening, gripper.grip.width);
}

ActuatorState After(const ActuatorState* before, ActuatorState next) {
  const auto* gripper = std::get_if<GripperSetup>(&next.setup->kind);
  if (gripper == nullptr) return next;
  next.opening_before = before != nullptr ? OpeningOf(*before, next.since) : gripper->opening;
  if (before != nullptr && !IsToldToOpen(next)) next.grip = before->grip;
  return next;
}

}  // namespace gsv::world
