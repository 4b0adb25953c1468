#include "gsv/simulation/robots/actuator_acts.h"

#include <algorithm>
#include <map>

#include "gsv/sensing/actuator.h"

namespace gsv::simulation {

base::Result<ActuatorAct> MakeAct(const MountedSensor& actuator, world::ActuatorOrder order,
                                  const std::string& robot) {
  const std::string where = robot + "/" + actuator.name();
  const sensing::Actuator* const of = actuator.actuator();
  if (of == nullptr) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "a sensor cannot be told anything", where);
  }
  if (auto ok = of->Check(order); !ok) {
    return base::Fail(base::ErrorCode::kInvalidArgument, ok.error().message, where);
  }
  return ActuatorAct{actuator.name(), of->setup(), std::move(order)};
}

void Add(ActuatorAct act, ActuatorActs& acts) {
  const auto same = std::find_if(acts.begin(), acts.end(), [&](const ActuatorAct& earlier) {
    return earlier.actuator == act.actuator;
  });
  if (same == acts.end()) return acts.push_back(std::move(act));
  *same = std::move(act);
}

void Obey(std::vector<std::pair<std::string, ActuatorActs>> acts, world::State& state) {
  std::map<std::pair<std::string, std::string>, world::ActuatorStatePtr> all;
  if (state.actuators != nullptr) {
    for (const world::ActuatorStatePtr& each : *state.actuators) {
      all.emplace(std::pair(each->robot, each->actuator), each);
    }
  }
  for (auto& [robot, of_robot] : acts) {
    for (ActuatorAct& act : of_robot) {
      std::pair key(robot, act.actuator);
      if (!act.order) {
        all.erase(key);
        continue;
      }
      world::ActuatorStatePtr& now = all[std::move(key)];
      now = std::make_shared<const world::ActuatorState>(world::After(
          now.get(),
          {robot, act.actuator, std::move(act.setup), *std::move(act.order), state.time}));
    }
  }
  auto after = std::make_shared<world::Actuators>();
  after->reserve(all.size());
  for (auto& [key, each] : all) after->push_back(std::move(each));
  state.actuators = std::move(after);
}

}  // namespace gsv::simulation
