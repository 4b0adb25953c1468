// The faults of a run. A fault is applied at the first instant at or after its time, before any
// agent is woken or reads.
#pragma once

#include <optional>
#include <string>

#include "gsv/geometry/pose.h"

namespace gsv::scenario {

// The place of a key in its file, "room.yaml:7:5", for mistakes that are found later. All places
// compare equal.
struct SourcePlace {
  std::string text;
  friend bool operator==(const SourcePlace&, const SourcePlace&) { return true; }
};

// The pose of a robot at the start, or of a body that is placed, in the world: metres and radians.
// The numbers are kept unchanged, so that a repeated run starts bit-identical.
struct Place {
  double x = 0;
  double y = 0;
  std::optional<double> z;  // of the model's origin; default: the model stands on the floor
  double yaw = 0;

  geometry::Pose pose() const { return geometry::PlanarPose(x, y, z.value_or(0), yaw); }
  friend bool operator==(const Place&, const Place&) = default;
};

struct Fault {
  enum class Kind {
    kSensorSilent,   // robot/sensor: its newest sample no longer changes
    kSensorError,    // robot/sensor: reading it returns an error
    kBehaviourDies,  // robot: as if its process had ended
    kMotorFails,     // robot: its drive stops; robot/joint: the joint has no motor any more
    kBodyMoves,      // body: is moved to `place`
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
