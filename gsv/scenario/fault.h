// The faults of a run. A fault is applied at the first instant at or after its time, before any
// agent wakes or reads a sensor.
#pragma once

#include <optional>
#include <string>

#include "gsv/geometry/pose.h"

namespace gsv::scenario {

// The place of a key in its file, such as "room.yaml:7:5", for messages about errors. operator==
// always returns true: two faults are equal even if they are at different places of a file.
struct SourcePlace {
  // FILE:LINE:COLUMN in a file, or the field in a request, such as "faults[1]". Empty for a fault
  // that a program made.
  std::string text;
  friend bool operator==(const SourcePlace&, const SourcePlace&) { return true; }
};

// A pose in the world, in metres and radians: the start pose of a robot, or the pose to which a
// body is moved. The numbers are kept unchanged, so that a repeated run starts bit-identical.
struct Place {
  double x = 0;
  double y = 0;
  // height of the model's origin; if not set, the model stands on the floor
  std::optional<double> z;
  double yaw = 0;  // rad

  geometry::Pose pose() const { return geometry::PlanarPose(x, y, z.value_or(0), yaw); }
  friend bool operator==(const Place&, const Place&) = default;
};

// One fault of a scenario.
struct Fault {
  enum class Kind {
    kSensorSilent,   // robot/sensor: the sensor keeps returning its last sample
    kSensorError,    // robot/sensor: reading the sensor returns an error
    kBehaviourDies,  // robot: the behaviour ends, as if its process had been killed
    kMotorFails,     // robot: the drive stops; robot/joint: the joint loses its motor
    kBodyMoves,      // body: the body is moved to `place`
    kJointMoves,     // body/joint: the joint is commanded to `target`; `unit` names the quantity
  };
  // The quantity that `target` sets: a position (rad or m), a velocity (rad/s or m/s), or an effort
  // (N m or N).
  enum class Unit { kPosition, kVelocity, kEffort };

  Kind kind = Kind::kSensorSilent;
  double at = 0;                // simulated time, s
  std::string body;             // the name of a robot or object
  std::string part;             // the name of a sensor or joint; empty for the body itself
  Place place;                  // for kBodyMoves
  Unit unit = Unit::kPosition;  // for kJointMoves
  double target = 0;            // for kJointMoves
  SourcePlace source{};         // place of the fault in the scenario file

  friend bool operator==(const Fault&, const Fault&) = default;
};

}  // namespace gsv::scenario
