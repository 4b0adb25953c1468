// The API for applications: find a simulator through the broker, create a simulation, add robots,
// run it and read its state.
//
// Units    metres, radians; simulated time.
// Errors   every call ends within its time limit. An error says what failed, and where.
// Threads  one thread per object.
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

// The options of a simulation to create.
struct SimulationRequest {
  std::string world;  // a file, built-in world or model; empty for the server's default
  bool lockstep = true;
  double factor = 1;  // the target real-time factor, 0 for the world's own; ignored in lockstep
  SimTime step{0};    // 0 for the world's own step
  std::uint64_t seed = 0;
  std::string name;  // empty if the server chooses it
  // Further options, with the names of sba::SimulationSpecification::options: "on_failure",
  // "deadline_s", "abandoned_after_s".
  std::map<std::string, std::string> options;
};

// A robot to add. Its start pose is in metres and radians, in the world frame.
struct RobotRequest {
  std::string model;  // file, folder or name of a model
  double x = 0, y = 0, yaw = 0;
  std::string behaviour;  // the name of an offer; empty for a robot without a behaviour
  std::string name;       // if empty, the robot gets the name of its model
  // Makes a behaviour that runs in this process, on its own thread. Such a behaviour needs no
  // offer.
  BehaviourFactory own_behaviour;
};

// The state of a robot in a simulation.
struct RobotState {
  std::string name, model, behaviour;
  // state of the behaviour: "running", "waiting", "finished", "unresponsive", "dead", …
  std::string agent;
  Placement place;      // world_from_robot
  double distance = 0;  // driven distance, m
  // Number of contacts that have begun. A contact counts once, even if it lasts many steps.
  std::uint64_t collisions = 0;
};

// The state of a simulation and its robots at one instant.
struct SimulationState {
  // "created", "running", "paused", …, or "lost" if the server has ended. For a lost simulation,
  // time and robots are the last known values.
  std::string phase;
  SimTime time{0};
  double real_time_factor = 0;   // actual real-time factor
  std::uint64_t late_steps = 0;  // number of steps that started late, in real time
  // The robot that the simulation waits for, such as "robot_3 (wander on host:pid) since 2.1 s";
  // empty if there is none.
  std::string waiting_for;
  std::string failure;  // why the simulation failed; empty if it has not failed
  std::vector<RobotState> robots;
};

// A simulation on a server. The destructor destroys the simulation.
//
// If the server has ended, the simulation is lost permanently, and every call except State() fails
// with kUnavailable. A server counts as ended if its port refuses connections, or if it does not
// answer for half a minute during RunUntil().
class RemoteSimulation {
 public:
  virtual ~RemoteSimulation() = default;

  // Adds a robot and returns its name.
  virtual base::Result<std::string> AddRobot(const RobotRequest& robot) = 0;
  virtual base::Status RemoveRobot(const std::string& name) = 0;
  virtual base::Status Start() = 0;
  virtual base::Status Pause() = 0;
  virtual base::Status Resume() = 0;
  virtual base::Status Stop() = 0;
  // Returns to the start with the same robots.
  virtual base::Status Reset() = 0;
  // Sets the target real-time factor from the next step on, in (0, 1e6]. A reset keeps it. Fails
  // with kInvalidArgument in lockstep, which runs as fast as possible.
  virtual base::Status SetRealTimeFactor(double factor) = 0;
  [[deprecated("use SetRealTimeFactor()")]] base::Status SetFactor(double factor) {
    return SetRealTimeFactor(factor);
  }
  // Runs a command of the server by name. Commands that this library does not know are possible as
  // well (see `gsv --help` or sba::Simulation::commands()). Values are texts such as "-1.62" or
  // "true". Fails with kInvalidArgument for an unknown command or an invalid argument.
  virtual base::Status Command(const std::string& name,
                               const std::map<std::string, std::string>& arguments = {}) = 0;
  // Runs until the instant and pauses there. Blocks until then, at most for `timeout` of wall-clock
  // time. Calls `keep_waiting` at least every two seconds. If `keep_waiting` returns false, this
  // function returns kEnded and the run continues. Also returns kEnded if the run is paused by
  // someone else, or ends, before the instant.
  virtual base::Status RunUntil(SimTime until,
                                std::chrono::seconds timeout = std::chrono::minutes(10),
                                const std::function<bool()>& keep_waiting = {}) = 0;
  // Returns the current state of the simulation.
  virtual base::Result<SimulationState> State() = 0;
  // Returns a hash of the simulation's state. Equal runs have equal hashes.
  virtual base::Result<std::string> StateHash() = 0;
  // Returns the address of the viewer, or an empty text if the server has none.
  virtual base::Result<std::string> ViewerUrl() = 0;
  // Records to a file on the simulator's machine.
  virtual base::Status StartRecording(const std::string& path) = 0;
  // Ends the recording and completes its file.
  virtual base::Status StopRecording() = 0;
};

// A connection to a broker, through which an application finds simulators.
class Application {
 public:
  // `broker` is corbaloc::1.2@HOST:PORT/TradingService.
  static base::Result<std::unique_ptr<Application>> Connect(const std::string& broker);
  virtual ~Application() = default;

  // Creates a simulation on a simulator whose offer matches `constraint`. If `constraint` is empty,
  // any simulator matches. docs/services.md lists the properties that a constraint can use.
  // Simulators are tried in the order of `preference` ("first", "min load", "random").
  virtual base::Result<std::unique_ptr<RemoteSimulation>> Create(
      const SimulationRequest& request, const std::string& constraint = "",
      const std::string& preference = "first") = 0;
};

}  // namespace gsv
