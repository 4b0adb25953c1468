// Putting simulations together: what the gateway needs from the program around it so that people
// can create simulations and change who stands in them.
//
// Units    metres, radians, seconds.
// Errors   name the field of the request that they concern, as in "robots[1].model"; empty: none in
//          particular.
// Threads  any; reading a world and waiting for behaviours take their time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gsv/scenario/scenario.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

struct FieldError {
  base::Error error;
  std::string field;
};
template <typename T>
using FieldResult = tl::expected<T, FieldError>;
inline tl::unexpected<FieldError> WrongField(std::string field, base::Error error) {
  return tl::make_unexpected(FieldError{std::move(error), std::move(field)});
}

struct SimulationRequest {
  scenario::Scenario scenario;
  bool record = false;  // to a file that the server names
};

// Where a body is to stand.
struct Placement {
  geometry::Pose world_from_body;
  bool on_ground = true;  // the height counts for nothing
};

// A thing that is no robot: of a model, or like a body that stands in the simulation, came with its
// world or was removed from it.
struct ObjectRequest {
  std::string name;                // empty: after its model
  std::string model, copy_of;      // one of the two
  std::optional<Placement> place;  // without one: the first that is free
};

class SimulationFactory {
 public:
  struct ModelLine {
    std::string name;
    bool is_avatar = false;
  };
  struct BehaviourLine {
    std::string name, description, host;
    std::int32_t pid = 0;
    bool time_managed = true;
  };
  struct Behaviours {
    std::vector<BehaviourLine> offers;
    std::string broker;         // its address
    std::string start_command;  // a program that would offer one
  };
  struct Preview {
    std::shared_ptr<simulation::Simulation> simulation;  // never runs, and is in no list
    std::vector<std::string> warnings;                   // what the files lack
  };

  virtual ~SimulationFactory() = default;

  virtual std::vector<std::string> Worlds() = 0;   // ours
  virtual std::vector<ModelLine> Models() = 0;     // that can be robots, ours and on the model path
  virtual std::vector<std::string> Objects() = 0;  // models that are no robots, as well
  virtual base::Result<Behaviours> FindBehaviours(const std::string& constraint) = 0;

  // As it would stand at its start, without behaviours.
  virtual FieldResult<Preview> Show(const SimulationRequest& request) = 0;
  // Not started yet; recorded if that was asked for.
  virtual FieldResult<std::shared_ptr<simulation::Simulation>> Create(
      const SimulationRequest& request) = 0;
  virtual base::Status Destroy(const std::string& simulation) = 0;
  // Gives the name under which it stands.
  virtual FieldResult<std::string> AddRobot(
      const std::shared_ptr<simulation::Simulation>& simulation, const scenario::RobotEntry& robot,
      bool is_avatar) = 0;
  virtual FieldResult<std::string> AddObject(
      const std::shared_ptr<simulation::Simulation>& simulation, const ObjectRequest& object) = 0;
};

}  // namespace gsv::gateway
