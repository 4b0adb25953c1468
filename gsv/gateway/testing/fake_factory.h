// For tests: a factory of scripted simulations.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/gateway/program/simulation_factory.h"
#include "gsv/gateway/testing/scripted_simulation.h"
#include "gsv/gateway/testing/simulation_list.h"

namespace gsv::gateway::testing {

// A factory that records requests, and refuses them on demand.
class FakeFactory final : public SimulationFactory {
 public:
  explicit FakeFactory(SimulationList& list) : list_(list) {}

  std::vector<std::string> Worlds() override { return {"maze", "<b>office</b>"}; }
  std::vector<ModelLine> Models() override { return {{"avatar", true}, {"pebble", false}}; }
  std::vector<std::string> Objects() override { return {"crate"}; }
  base::Result<Behaviours> FindBehaviours(const std::string& constraint) override {
    if (constraint == "1 +") {
      return base::Fail(base::ErrorCode::kInvalidArgument, "it ends too early", constraint);
    }
    return Behaviours{{{"wander", constraint, "here", 7, true}}, "corbaloc:", "gsv-wander"};
  }
  Ros2Support Ros2() override { return ros2; }
  FieldResult<Preview> Show(const SimulationRequest& request) override {
    if (refusal) return base::Failure{*refusal};
    return Preview{std::make_shared<ScriptedSimulation>(request.scenario.world, 2), {"no mesh"}};
  }
  FieldResult<std::shared_ptr<simulation::Simulation>> Create(
      const SimulationRequest& request) override {
    if (refusal) return base::Failure{*refusal};
    auto made = std::make_shared<ScriptedSimulation>(request.scenario.name, 0);
    list_.Add(made);
    return made;
  }
  base::Status Destroy(const std::string& simulation) override {
    list_.Remove(simulation);
    return {};
  }
  FieldResult<std::string> AddRobot(const std::shared_ptr<simulation::Simulation>&,
                                    const scenario::RobotEntry& robot, bool is_avatar) override {
    if (refusal) return base::Failure{*refusal};
    return robot.model + (is_avatar ? "_avatar" : "_robot");
  }

  FieldResult<std::string> AddObject(const std::shared_ptr<simulation::Simulation>&,
                                     const ObjectRequest& object) override {
    if (refusal) return base::Failure{*refusal};
    asked = object;
    return object.model + object.copy_of;
  }

  base::Result<SavedWorld> SaveWorld(const simulation::Simulation&,
                                     const std::string& file) override {
    if (refusal) return base::Fail(refusal->error);
    return SavedWorld{"<sdf/>", "world: " + file + "\n", {"no mesh"}};
  }

  Ros2Support ros2;                   // the result of Ros2()
  std::optional<FieldError> refusal;  // if set, requests are refused with this error
  ObjectRequest asked;                // the last requested object

 private:
  SimulationList& list_;
};

}  // namespace gsv::gateway::testing
