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
#include <vector>

#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

struct FieldError {
  base::Error error;
  std::string field;
};
template <typename T>
using FieldResult = tl::expected<T, FieldError>;

struct Place {
  double x = 0, y = 0;
  std::optional<double> z;  // without one it stands on the ground
  double yaw = 0;
};

struct RobotRequest {
  std::string name;                  // empty: after its model
  std::string model;                 // a name, or a file or folder on the server's machine
  std::optional<Place> place;        // without one: the first that is free
  std::string behaviour;             // an offer's name; empty: none
  std::string behaviour_constraint;  // or what an offer must fulfil
  std::optional<model::Movement> movement;
};

struct SimulationRequest {
  std::string name;   // empty: one is chosen
  std::string world;  // one of ours, or a file or folder on the server's machine
  simulation::Mode mode = simulation::Mode::kRealTime;
  double factor = 1;
  double step = 0;      // 0: the world's
  double duration = 0;  // 0: until it is stopped
  std::uint64_t seed = 0;
  bool record = false;
  std::vector<RobotRequest> robots, avatars;
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

  virtual std::vector<std::string> Worlds() = 0;  // ours
  virtual std::vector<ModelLine> Models() = 0;    // that can be robots, ours and on the model path
  virtual base::Result<Behaviours> FindBehaviours(const std::string& constraint) = 0;

  // As it would stand at its start, without behaviours.
  virtual FieldResult<Preview> Show(const SimulationRequest& request) = 0;
  // Not started yet; recorded if that was asked for.
  virtual FieldResult<std::shared_ptr<simulation::Simulation>> Create(
      const SimulationRequest& request) = 0;
  virtual base::Status Destroy(const std::string& simulation) = 0;
  // Gives the name under which it stands.
  virtual FieldResult<std::string> AddRobot(
      const std::shared_ptr<simulation::Simulation>& simulation, const RobotRequest& robot,
      bool is_avatar) = 0;
};

}  // namespace gsv::gateway
