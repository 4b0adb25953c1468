// The data structures of a simulation: its specification, status and events.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/sim_time.h"
#include "gsv/model/pedestrian_group.h"
#include "gsv/model/world_description.h"
#include "gsv/scenario/fault.h"
#include "gsv/sensing/reading.h"
#include "gsv/simulation/edit.h"
#include "gsv/world/state.h"

namespace gsv::simulation {

using base::SimTime;

// How simulated time relates to wall-clock time.
enum class Mode {
  // Steps follow the wall clock, scaled by the real-time factor. The simulation does not wait for
  // agents.
  kRealTime,
  // The simulation runs as fast as possible. It takes a step when every agent waits, so runs are
  // reproducible.
  kLockstep,
};

// The transitions are created → starting → running → paused → starting. A run is "finished" when
// its duration is over, and "stopped" by request. It is "failed" when a behaviour failed with
// FailurePolicy::kFail, when an in-process behaviour exceeded the deadline, or when a fault could
// not be applied.
enum class Phase { kCreated, kStarting, kRunning, kPaused, kStopped, kFinished, kFailed };

const char* ToString(Mode mode);
const char* ToString(Phase phase);

// The effect on a run if a behaviour is dead or unresponsive.
enum class FailurePolicy { kContinue, kFail };

// The parameters of a new simulation.
struct Specification {
  std::string name = "simulation";
  std::shared_ptr<const model::WorldDescription> world;  // never null
  Mode mode = Mode::kRealTime;
  double factor = 1;       // the target real-time factor for kRealTime; 0 for the world's
  SimTime step{0};         // 0 for the world's max_step_size
  std::uint64_t seed = 0;  // seed of all random numbers of the simulation
  SimTime duration{0};     // if 0, the run ends only when it is stopped
  FailurePolicy on_failure = FailurePolicy::kContinue;  // applies to every behaviour of the run
  // The wall-clock time that an agent may run before it counts as unresponsive.
  std::chrono::milliseconds deadline{10'000};
  bool keep = false;  // whether the simulation continues to exist after its creator has ended
  // groups of pedestrians that are added to those of the world
  std::vector<model::PedestrianGroup> pedestrians;
  std::vector<scenario::Fault> faults;  // see scenario/fault.h
  // Number of threads for bodies and local behaviours. 0 means: all processors in lockstep, else
  // one thread.
  int threads = 0;
  // A robot counts as stuck if it did not move for this long although it was commanded to move.
  // Must be > 0.
  SimTime stuck_after = std::chrono::seconds(5);
};

// The phase of a robot's agent. kFinished: the behaviour has closed all its clocks.
enum class AgentPhase { kNone, kInitialised, kRunning, kWaiting, kFinished, kUnresponsive, kDead };

const char* ToString(AgentPhase phase);

// The recent motion of a robot's base. It is sampled every 0.1 s of simulated time
// (history/motion_history.h).
struct Motion {
  bool is_moving = false;  // whether the base has moved within the last second
  bool has_moved = false;  // whether the robot has moved since the start, or since it was added
  SimTime since{0};        // time since which the robot has been moving, or at rest
  bool is_stuck = false;   // whether it was commanded to move for stuck_after, without effect
  // Simulated time for which the robot has been commanded to move since its last motion.
  SimTime commanded_for{0};
  world::DriveCommand command;  // current command; zero after the drive's command timeout
  double linear = 0;            // speed of the robot's origin, m/s
  double angular = 0;           // turning rate about the vertical, rad/s
  std::string contact;          // a body that the robot touches, except the ground; empty if there
                                // is none
  SimTime contact_since{0};     // time since which the robot touches `contact`
};

// The status of one robot, with its behaviour and its motion.
struct RobotStatus {
  std::string name;
  std::string model;
  std::string behaviour;        // name of the robot's behaviour; empty if there is none
  std::string behaviour_place;  // "host:pid" of the behaviour's program
  bool is_avatar = false;
  bool is_station = false;  // whether this is an object with sensors (world/station.h)
  AgentPhase phase = AgentPhase::kNone;
  std::string detail;       // why the agent is dead or unresponsive
  std::string cause;        // the error that the behaviour reported; empty if there is none
  SimTime detail_since{0};  // time since which `detail` applies
  geometry::Pose world_from_robot;
  double distance = 0;  // driven distance, m
  // number of contacts that have begun, see BodyState
  std::uint64_t collisions = 0;
  // number of readings that the behaviour received, by sensor type
  std::map<std::string, std::uint64_t> readings;
  Motion motion;
  // The wall-clock time for which the behaviour has run without waiting. 0 while the behaviour
  // waits, and if the simulation does not manage the behaviour's time.
  std::chrono::nanoseconds running_for{0};
};

// The status of a simulation and its robots.
struct SimulationStatus {
  std::string name;
  Phase phase = Phase::kCreated;
  Mode mode = Mode::kRealTime;
  std::int64_t step = 0;
  SimTime time{0};
  SimTime step_size{0};
  double target_factor = 1;  // target real-time factor
  // The actual real-time factor. While the simulation runs: over about the last second. Otherwise:
  // over the whole run.
  double real_time_factor = 0;
  std::chrono::nanoseconds wall_time{0};       // wall-clock time spent running
  std::uint64_t late_steps = 0;                // number of steps that started late, see pacer.h
  std::chrono::nanoseconds mean_step_time{0};  // wall-clock time per step
  // The agent that the simulation waits for, such as "robot_3 (wander on host:pid) since 2.1 s".
  // Empty if there is none.
  std::string waiting_for;
  std::string failure;              // why the simulation failed
  std::uint64_t events = 0;         // number of lifecycle events so far
  std::uint64_t outputs = 0;        // number of lines that the programs of behaviours printed
  std::vector<RobotStatus> robots;  // ordered by name, including avatars and stations

  std::size_t CountRobots() const {  // Returns the number of robots, not stations.
    return static_cast<std::size_t>(std::count_if(
        robots.begin(), robots.end(), [](const RobotStatus& each) { return !each.is_station; }));
  }
};

// An event at a step, such as a start, a pause, a death or an added robot.
struct Event {
  std::int64_t step = 0;
  SimTime time{0};
  std::string kind;   // "started", "paused", "resumed", "stopped", "robot_added", "agent_dead", …
  std::string robot;  // empty if the event concerns the whole simulation
  std::string detail;
  std::shared_ptr<const Edit> edit;  // null if the event is not an edit
};

// The kinds of events that are output of behaviours' programs: a line on stdout, a line on stderr,
// and the end of a program. These events depend on the wall clock, and are stored separately.
inline constexpr std::string_view kStdoutEvent = "stdout";
inline constexpr std::string_view kStderrEvent = "stderr";
inline constexpr std::string_view kProgramEndedEvent = "program_ended";

// Whether the event is output of a behaviour's program.
inline bool IsOutput(const Event& event) {
  return event.kind == kStdoutEvent || event.kind == kStderrEvent ||
         event.kind == kProgramEndedEvent;
}

// The current state of a scenario's expectation.
struct ExpectationState {
  enum class Verdict { kPending, kHolds, kViolated };

  std::string name;
  std::string yaml;   // the complete YAML, on one line
  std::string where;  // place of the expectation in the scenario file
  Verdict verdict = Verdict::kPending;
  std::int64_t step = 0;  // step of the verdict
  SimTime time{0};
  // The margin is the distance to the limit, negative beyond the limit. This is the smallest margin
  // so far. For a condition that must become true once, it is the largest margin so far. Not set if
  // the expectation has no margin.
  std::optional<double> margin;
  std::string unit;                 // unit of the margin; empty if it has none
  SimTime margin_at{0};             // time of the margin
  std::string detail;               // detail of a violation
  std::vector<std::string> bodies;  // bodies that the expectation names
  // A circle in which a body must be, or must not be.
  struct Place {
    double x = 0, y = 0, radius = 0;  // m
  };
  std::vector<Place> places;  // the circles of the expectation's conditions
  // A rectangle in which a body must be, or must not be.
  struct Box {
    double x_min = 0, x_max = 0, y_min = 0, y_max = 0;  // m; an infinite value means no limit
  };
  std::vector<Box> boxes;  // the rectangles of the expectation's conditions
};

const char* ToString(ExpectationState::Verdict verdict);

}  // namespace gsv::simulation
