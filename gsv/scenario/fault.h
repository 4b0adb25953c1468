// The faults of a run. A fault is applied at the first instant at or after its time, before any
// agent is woken or reads.
#pragma once

#include <optional>
#include <string>

#include "gsv/geometry/pose.h"

namespace gsv::scenario {

// The place of a key in its file, such as "room.yaml:7:5", for errors that are found later. All
// places compare equal.
struct SourcePlace {
  std::string text;
  friend bool operator==(const SourcePlace&, const SourcePlace&) { return true; }
};

// A pose in the world, in metres and radians: that of a robot at the start, or of a body that is
// placed. The numbers are kept unchanged, so that a repeated run starts bit-identical.
struct Place {
  double x = 0;
  double y = 0;
  // height of the model's origin; nullopt for a model that stands on the floor
  std::optional<double> z;
  double yaw = 0;

  geometry::Pose pose() const { return geometry::PlanarPose(x, y, z.value_or(0), yaw); }
  friend bool operator==(const Place&, const Place&) = default;
};

struct Fault {
  enum class Kind {
    kSensorSilent,   // robot/sensor: the newest sample of the sensor no longer changes
    kSensorError,    // robot/sensor: reading the sensor returns an error
    kBehaviourDies,  // robot: the behaviour ends as if its process had ended
    kMotorFails,     // robot: its drive stops; robot/joint: the joint has no motor any more
    kBodyMoves,      // body: the body is moved to `place`
    kJointMoves,     // body/joint: the joint moves to `target` in the unit of `unit`
  };
  enum class Unit { kPosition, kVelocity, kEffort };  // rad or m, rad/s or m/s, N m or N

  Kind kind = Kind::kSensorSilent;
  double at = 0;     // simulated time, s
  std::string body;  // the name of a robot or object
  std::string part;  // the name of a sensor or joint; empty for the body itself
  Place place;
  Unit unit = Unit::kPosition;
  double target = 0;
  SourcePlace source{};

  friend bool operator==(const Fault&, const Fault&) = default;
};

}  // namespace gsv::scenario
