// The plain data of a simulation: its specification, status and events.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/sim_time.h"
#include "gsv/model/pedestrian_group.h"
#include "gsv/model/world_description.h"
#include "gsv/scenario/fault.h"
#include "gsv/sensing/reading.h"
#include "gsv/simulation/edit.h"

namespace gsv::simulation {

using base::SimTime;

enum class Mode {
  // Steps follow the wall clock times the real-time factor; the simulation waits for no agent.
  kRealTime,
  kLockstep,  // as fast as possible; the step is taken when every agent waits (reproducible)
};

// created → starting → running ⇄ paused. finished: the duration is over; failed: a behaviour
// failed, with FailurePolicy::kFail; stopped: by request.
enum class Phase { kCreated, kStarting, kRunning, kPaused, kStopped, kFinished, kFailed };

const char* ToString(Mode mode);
const char* ToString(Phase phase);

// The effect of a dead or unresponsive behaviour on the run.
enum class FailurePolicy { kContinue, kFail };

struct Specification {
  std::string name = "simulation";
  std::shared_ptr<const model::WorldDescription> world;  // never null
  Mode mode = Mode::kRealTime;
  double factor = 1;  // kRealTime: target real-time factor, > 0
  SimTime step{0};    // 0: the world's max_step_size
  std::uint64_t seed = 0;
  SimTime duration{0};  // 0: until stopped
  FailurePolicy on_failure = FailurePolicy::kContinue;
  // Wall-clock time that an agent may run before it counts as unresponsive.
  std::chrono::milliseconds deadline{10'000};
  bool keep = false;                                // kept after its creator has gone
  std::vector<model::PedestrianGroup> pedestrians;  // besides the world's own
  std::vector<scenario::Fault> faults;              // see scenario/fault.h
  // Number of threads for bodies and local behaviours; 0: in lockstep the number of processors,
  // else one.
  int threads = 0;
};

enum class AgentPhase { kNone, kInitialised, kRunning, kWaiting, kFinished, kUnresponsive, kDead };

const char* ToString(AgentPhase phase);

struct RobotStatus {
  std::string name;
  std::string model;
  std::string behaviour;  // empty: none
  bool is_avatar = false;
  bool is_station = false;  // an object with sensors (world/station.h)
  AgentPhase phase = AgentPhase::kNone;
  std::string detail;  // why it is dead or unresponsive
  geometry::Pose world_from_robot;
  double distance = 0;  // m
  std::uint64_t collisions = 0;
  std::map<std::string, std::uint64_t> readings;  // taken by the behaviour, by sensor type
};

struct SimulationStatus {
  std::string name;
  Phase phase = Phase::kCreated;
  Mode mode = Mode::kRealTime;
  std::int64_t step = 0;
  SimTime time{0};
  SimTime step_size{0};
  double target_factor = 1;
  // Actual: over about the last second while running, else over the run.
  double real_time_factor = 0;
  std::chrono::nanoseconds wall_time{0};  // spent running
  std::uint64_t late_steps = 0;
  std::chrono::nanoseconds mean_step_time{0};  // wall-clock time per step
  std::string waiting_for;          // "robot_3 (wander on host:pid) since 2.1 s"; empty: nobody
  std::string failure;              // why it failed
  std::uint64_t events = 0;         // number of lifecycle events so far
  std::vector<RobotStatus> robots;  // by name; including avatars and stations

  std::size_t CountRobots() const {  // stations are none
    return static_cast<std::size_t>(std::count_if(
        robots.begin(), robots.end(), [](const RobotStatus& each) { return !each.is_station; }));
  }
};

// Something that happened at a step: a start, a pause, a death, a robot added.
struct Event {
  std::int64_t step = 0;
  SimTime time{0};
  std::string kind;   // "started", "paused", "resumed", "stopped", "robot_added", "agent_dead", …
  std::string robot;  // empty: the simulation
  std::string detail;
  std::shared_ptr<const Edit> edit;  // null: not an edit
};

}  // namespace gsv::simulation
