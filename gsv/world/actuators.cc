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

}  // namespace gsv::world
