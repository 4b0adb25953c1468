// SimulationFactory is the interface with which the gateway creates and edits simulations. The
// program that contains the gateway implements it.
//
// Units    metres, radians, seconds.
// Errors   name the field of the request that caused them, such as "robots[1].model". The name is
//          empty if no single field caused the error.
// Threads  any; calls may block to read a world and to wait for behaviours.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gsv/scenario/scenario.h"
#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// An error, and the name of the request's field that caused it.
struct FieldError {
  base::Error error;
  std::string field;  // empty if no single field caused the error
};
template <typename T>
using FieldResult = base::ResultOf<T, FieldError>;
inline base::Failure<FieldError> WrongField(std::string field, base::Error error) {
  return base::Failure{FieldError{std::move(error), std::move(field)}};
}

// A request to create a simulation.
struct SimulationRequest {
  scenario::Scenario scenario;  // the simulation to create, as in a scenario file
  bool record = false;          // whether to record to a file that the server chooses
};

// The requested pose of a body.
struct Placement {
  geometry::Pose world_from_body;
  bool on_ground = true;  // whether the body stands on the floor; the height is then ignored
};

// A new object: from a model, or a copy of a body. The body exists now, was removed, or was in the
// world at its start.
struct ObjectRequest {
  std::string name;                // the name; empty: derived from the model
  std::string model, copy_of;      // name of the model or of the body; exactly one is set
  std::optional<Placement> place;  // default: the first free place
};

// The interface through which the gateway creates and edits simulations.
class SimulationFactory {
 public:
  // A model in a list for users.
  struct ModelLine {
    std::string name;
    bool is_avatar = false;
  };
  // A behaviour that the broker offers, see BehaviourOffer.
  struct BehaviourLine {
    std::string name, description, host;
    std::int32_t pid = 0;  // id of the process that offers the behaviour
    bool time_managed = true;
  };
  // The answer of FindBehaviours().
  struct Behaviours {
    std::vector<BehaviourLine> offers;
    std::string broker;         // address of the broker
    std::string start_command;  // example of a command that starts a behaviour at this broker
  };
  // Whether simulations can be published to ROS 2 nodes, by the key `ros2` of their scenario.
  struct Ros2Support {
    bool is_available = false;
    std::string reason;     // the reason if ROS 2 is not available
    std::string reach;      // the ROS domain, and which machines can be reached in it
    std::string published;  // the simulation that is published now; empty: none
  };
  // A world at its start, for a preview on the page.
  struct Preview {
    std::shared_ptr<simulation::Simulation> simulation;  // is not listed and never runs
    std::vector<std::string> warnings;                   // problems of the files
  };

  // The present state of a world, and a scenario with the parts that a world file cannot contain:
  // behaviours, avatars, seed, faults.
  struct SavedWorld {
    std::string sdf, scenario;          // the texts of the world file and of the scenario file
    std::vector<std::string> warnings;  // the parts that are not saved
  };

  virtual ~SimulationFactory() = default;

  virtual std::vector<std::string> Worlds() = 0;  // names of the built-in worlds
  // Returns the models that can be robots: built-in models, and models on the model path.
  virtual std::vector<ModelLine> Models() = 0;
  // names of all models, also of models that are not robots
  virtual std::vector<std::string> Objects() = 0;
  // Returns the behaviours that the broker offers and for which the constraint is TRUE. An empty
  // constraint is TRUE for all.
  virtual base::Result<Behaviours> FindBehaviours(const std::string& constraint) = 0;

  // Whether simulations can be published to ROS 2.
  virtual Ros2Support Ros2() { return {}; }

  // Creates a preview of the initial state, without behaviours.
  virtual FieldResult<Preview> Show(const SimulationRequest& request) = 0;
  // Creates a simulation without starting it. If request.record is set, starts a recording.
  virtual FieldResult<std::shared_ptr<simulation::Simulation>> Create(
      const SimulationRequest& request) = 0;
  // Destroys the simulation with this name.
  virtual base::Status Destroy(const std::string& simulation) = 0;
  // Adds a robot and returns the name of its body.
  virtual FieldResult<std::string> AddRobot(
      const std::shared_ptr<simulation::Simulation>& simulation, const scenario::RobotEntry& robot,
      bool is_avatar) = 0;
  // Adds an object and returns the name of its body.
  virtual FieldResult<std::string> AddObject(
      const std::shared_ptr<simulation::Simulation>& simulation, const ObjectRequest& object) = 0;
  // Returns the texts of a world file and a scenario. `file` is the name of the world file in the
  // scenario. Poses are saved, velocities are not.
  virtual base::Result<SavedWorld> SaveWorld(const simulation::Simulation& simulation,
                                             const std::string& file) = 0;
};

}  // namespace gsv::gateway
