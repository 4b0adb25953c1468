// For robotic applications: find a simulator through the broker, create a simulation, put robots in
// it, run it, look at what came of it.
//
// Units    metres, radians; simulated time.
// Errors   every call ends within its time limit; what failed, and where, is in the error.
// Threads  one thread an object.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"
#include "sdk/behaviour/behaviour.h"

namespace gsv {

struct SimulationRequest {
  std::string world;  // a file or model that the server can find; empty: its default
  bool lockstep = true;
  double factor = 1;  // in real time
  SimTime step{0};    // 0: the world's
  std::uint64_t seed = 0;
  std::string name;  // empty: the server chooses
  // Further ones by the names of sba::SimulationSpecification::options: "on_failure", "deadline_s",
  // "abandoned_after_s".
  std::map<std::string, std::string> options;
};

struct RobotRequest {
  std::string model;
  double x = 0, y = 0, yaw = 0;
  std::string behaviour;  // the name of an offer; empty: none
  std::string name;       // empty: after its model
  // A behaviour of this program, which then needs no offer: it runs here, on a thread of its own.
  BehaviourFactory own_behaviour;
};

struct RobotState {
  std::string name, model, behaviour;
  std::string agent;    // "running", "waiting", "finished", "unresponsive", "dead", …
  Placement place;      // world_from_robot
  double distance = 0;  // m
  std::uint64_t collisions = 0;
};

struct SimulationState {
  // "created", "running", "paused", …; "lost": its server is gone, and it with that; time and
  // robots are as they were when they were last asked for.
  std::string phase;
  SimTime time{0};
  double real_time_factor = 0;
  std::uint64_t late_steps = 0;
  std::string waiting_for;
  std::string failure;
  std::vector<RobotState> robots;
};

// A simulation on some server. It is destroyed with this.
//
// Once its server is gone (its port refuses connections, or RunUntil() heard nothing from it for
// half a minute), it is lost for good: every call fails with kUnavailable and says so, but State().
class RemoteSimulation {
 public:
  virtual ~RemoteSimulation() = default;

  virtual base::Result<std::string> AddRobot(const RobotRequest& robot) = 0;
  virtual base::Status RemoveRobot(const std::string& name) = 0;
  virtual base::Status Start() = 0;
  virtual base::Status Pause() = 0;
  virtual base::Status Resume() = 0;
  virtual base::Status Stop() = 0;
  // Back to the start, with the same robots.
  virtual base::Status Reset() = 0;
  // In real time: simulated seconds a wall second from the next step on; above 0, at most 1e6. It
  // outlives a reset. Fails with kInvalidArgument in lockstep, which goes as fast as it can.
  virtual base::Status SetRealTimeFactor(double factor) = 0;
  [[deprecated("use SetRealTimeFactor()")]] base::Status SetFactor(double factor) {
    return SetRealTimeFactor(factor);
  }
  // Any command of the server by its name, also those that this library does not know: see
  // `gsv --help`, or sba::Simulation::commands(). Values are written as in "-1.62" or "true". Fails
  // with kInvalidArgument when there is no such command, or an argument does not fit it.
  virtual base::Status Command(const std::string& name,
                               const std::map<std::string, std::string>& arguments = {}) = 0;
  // Runs to that instant and freezes there; blocks until then. `patience` is wall time. `go_on` is
  // asked every two seconds of it at least; false: the run goes on, this returns kEnded.
  virtual base::Status RunUntil(SimTime until,
                                std::chrono::seconds patience = std::chrono::minutes(10),
                                const std::function<bool()>& go_on = {}) = 0;
  virtual base::Result<SimulationState> State() = 0;
  virtual base::Result<std::string> StateHash() = 0;
  virtual base::Result<std::string> ViewerUrl() = 0;
  // To a file on the simulator's machine.
  virtual base::Status StartRecording(const std::string& path) = 0;
  virtual base::Status StopRecording() = 0;
};

// The broker, as an application uses it.
class Application {
 public:
  // `broker`: corbaloc::1.2@HOST:PORT/TradingService.
  static base::Result<std::unique_ptr<Application>> Connect(const std::string& broker);
  virtual ~Application() = default;

  // On the first simulator, in the order of `preference` ("first", "min load", "random"), whose
  // offer matches `constraint` (over the properties of docs/services.md; empty: any).
  virtual base::Result<std::unique_ptr<RemoteSimulation>> Create(
      const SimulationRequest& request, const std::string& constraint = "",
      const std::string& preference = "first") = 0;
};

}  // namespace gsv
