// What is to go wrong in a run, and when: at the first instant at or after its time, before anybody
// is woken or reads there.
#pragma once

#include <optional>
#include <string>

#include "gsv/geometry/pose.h"

namespace gsv::scenario {

// "room.yaml:7:5": for whoever tells of a mistake that shows only later. All are equal.
struct SourcePlace {
  std::string text;
  friend bool operator==(const SourcePlace&, const SourcePlace&) { return true; }
};

// Where a robot starts, or a body is put, in the world: metres and radians. The numbers stay as
// they were given, so that a run that is repeated begins with the same bits.
struct Place {
  double x = 0;
  double y = 0;
  std::optional<double> z;  // of the model's origin; without it: it stands on the floor
  double yaw = 0;

  geometry::Pose pose() const { return geometry::PlanarPose(x, y, z.value_or(0), yaw); }
  friend bool operator==(const Place&, const Place&) = default;
};

struct Fault {
  enum class Kind {
    kSensorSilent,   // robot/sensor: its newest sample stays what it was
    kSensorError,    // robot/sensor: who reads it gets an error
    kBehaviourDies,  // robot: as if its process had ended
    kMotorFails,     // robot: its drive stands still; robot/joint: nothing moves it any more
    kBodyMoves,      // body: stands at `place`
    kJointMoves,     // body/joint: goes to `target` of `unit`
  };
  enum class Unit { kPosition, kVelocity, kEffort };  // rad or m, rad/s or m/s, N m or N

  Kind kind = Kind::kSensorSilent;
  double at = 0;     // s
  std::string body;  // a robot's or an object's name
  std::string part;  // a sensor's or a joint's; empty: the body itself
  Place place;
  Unit unit = Unit::kPosition;
  double target = 0;
  SourcePlace source{};

  friend bool operator==(const Fault&, const Fault&) = default;
};

}  // namespace gsv::scenario
