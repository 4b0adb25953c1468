// The health of robots: whether each one moves, stands, is stuck, touches something, is late or
// dead; its last command and its actual motion; and what limits it. Computed from a simulation's
// status and the readings of range sensors.
//
// Units        metres, radians, seconds; instants of simulated time.
// Determinism  all but `late` is a function of the states of the run.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gsv/simulation/types.h"

namespace gsv::health {

enum class State { kMoving, kStanding, kStuck, kContact, kLate, kDead };
inline constexpr std::size_t kStates = 6;

// "moving", "standing", "stuck", "contact", "late", "dead"
const char* ToString(State state);

enum class Level : std::uint8_t { kFine = 0, kWarning = 1, kError = 2 };

// A short distance that a sensor measures.
struct Limit {
  std::string sensor;
  double value = 0;  // m
  friend bool operator==(const Limit&, const Limit&) = default;
};

struct RobotHealth {
  std::string robot;
  State state = State::kMoving;
  // kWarning: stuck, in contact, late, or its behaviour has run for 10 s while it stood still.
  Level level = Level::kFine;
  base::SimTime since{0};  // of `state`
  world::DriveCommand command;
  double linear = 0, angular = 0;  // the actual motion, m/s and rad/s
  std::optional<Limit> limit;      // set for a robot that stands or is stuck
  std::string contact;             // a body that the robot touches; empty: none
  std::string summary;             // "has not moved", "has been stuck", "has been dead"
  std::string reason;              // "commanded 0, sonar_00 reads 0.26 m"; empty: none
};

struct Report {
  base::SimTime time{0};
  std::int64_t step = 0;
  base::SimTime stuck_after{0};
  std::array<std::uint32_t, kStates> counts{};  // by State
  std::vector<RobotHealth> robots;              // by name; without stations

  std::uint32_t CountOf(State state) const { return counts[static_cast<std::size_t>(state)]; }
};

// Returns the health of a robot in `status`, without its limit.
RobotHealth HealthOf(const simulation::RobotStatus& robot,
                     const simulation::SimulationStatus& status);
// Sets the limit, which is a part of the reason.
void SetLimit(std::optional<Limit> limit, RobotHealth& health);

// Returns "has not moved for 20 s: commanded 0, sonar_00 reads 0.26 m".
std::string Sentence(const RobotHealth& health, base::SimTime now);
// Returns "stood still from 15.7 s: …", for the end of a run; empty for a robot that moves.
std::string FinalSentence(const RobotHealth& health);
// Returns "3 move, 1 stands, 1 is stuck".
std::string Summary(const Report& report);

}  // namespace gsv::health
