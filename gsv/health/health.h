// The health of robots. For each robot, this is the state (State), the last command, the actual
// motion, and the obstacle that stops the robot. It is computed from a simulation's status and the
// readings of range sensors.
//
// Units        metres, radians, seconds; instants of simulated time.
// Determinism  everything except `late` depends only on the states of the run.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/simulation/types.h"

namespace gsv::health {

// A robot is stuck if it does not move although it is commanded to. A robot is late if its
// behaviour is unresponsive, or has run for 1 s of wall-clock time without calling a wait function.
// A robot is dead if its behaviour has crashed or was killed.
enum class State { kMoving, kStanding, kStuck, kContact, kLate, kDead };
inline constexpr std::size_t kStates = 6;  // number of values of State

// "moving", "standing", "stuck", "contact", "late", "dead"
const char* ToString(State state);
// Returns the state with this name, or nullopt if there is none.
std::optional<State> StateOf(std::string_view name);

// How serious a robot's state is.
enum class Level : std::uint8_t { kFine = 0, kWarning = 1, kError = 2 };

// Returns a number by which robots are sorted. From the highest to the lowest number, the states
// are dead, stuck, contact, late, standing, moving. In one state, a higher level is higher.
int Severity(State state, Level level);

// A short distance that a range sensor measures. The obstacle at this distance may be the reason
// why the robot does not move.
struct Limit {
  std::string sensor;  // name of the sensor
  double value = 0;    // m
  friend bool operator==(const Limit&, const Limit&) = default;
};

// The state of one robot and the reason for it.
struct RobotHealth {
  std::string robot;
  State state = State::kMoving;
  // kError if the robot is dead. kWarning if it is stuck, in contact or late, or if its behaviour
  // runs and the robot has not moved for 10 s.
  Level level = Level::kFine;
  base::SimTime since{0};          // start of `state`
  world::DriveCommand command;     // the last command
  double linear = 0, angular = 0;  // the actual motion, m/s and rad/s
  // Only for a robot that stands, is stuck or is in contact: the shortest distance that its range
  // sensors measure. Absent if this distance is not short, see FindLimit().
  std::optional<Limit> limit;
  std::string contact;  // a body that the robot touches; empty if there is none
  std::string summary;  // such as "has not moved", "has been stuck" or "has been dead"
  // Such as "commanded 0, sonar_00 reads 0.26 m"; empty if there is none.
  std::string reason;
};

// The health of all robots of a simulation at one instant.
struct Report {
  base::SimTime time{0};
  std::int64_t step = 0;         // number of the simulation's step
  base::SimTime stuck_after{0};  // time without motion after which a commanded robot is stuck
  std::array<std::uint32_t, kStates> counts{};  // number of robots in each State
  std::vector<RobotHealth> robots;              // ordered by name; without stations

  std::uint32_t CountOf(State state) const { return counts[static_cast<std::size_t>(state)]; }
};

// Returns the health of a robot in `status`, without `limit`.
RobotHealth HealthOf(const simulation::RobotStatus& robot,
                     const simulation::SimulationStatus& status);
// Sets `limit`, and adds it to the reason.
void SetLimit(std::optional<Limit> limit, RobotHealth& health);

// Returns a sentence such as "has not moved for 20 s: commanded 0, sonar_00 reads 0.26 m".
std::string Sentence(const RobotHealth& health, base::SimTime now);
// Returns a sentence for the end of a run, such as "stood still from 15.7 s: …"; empty for a robot
// that moves.
std::string FinalSentence(const RobotHealth& health);
// Returns a summary such as "3 move, 1 stands, 1 is stuck".
std::string Summary(const Report& report);

}  // namespace gsv::health
