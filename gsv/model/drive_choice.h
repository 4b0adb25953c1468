// The drive that a user chooses for a robot, and the conversion of a model to a robot.
//
// A choice is a text, the same on the command line, in scenarios and in recordings:
//
//   KIND[,KEY=VALUE]…   diff,left=front_left,left=rear_left,right=front_right,right=rear_right
//
// KIND      diff or skid (differential), ackermann, mecanum, omni (takes any velocity), none.
// KEY       left, right: a joint that turns a wheel; steer: a joint that steers; each may come
//           several times, or once with joints joined by "+". radius, separation, wheel_base in
//           metres, steering_limit in radians.
// Missing values are taken from the model's own drive of that kind, else guessed and measured
// (drive_guess.h).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/model.h"

namespace gsv::model {

struct DriveChoice {
  DriveKind kind = DriveKind::kNone;
  std::vector<std::string> left, right, steer;  // names of the joints
  std::optional<double> radius, separation, wheel_base, steering_limit;
};

// Returns kInvalidArgument with the expected form.
[[nodiscard]] base::Result<DriveChoice> ParseDriveChoice(const std::string& text);

// Returns the model as a robot. `choice` is a text as above. If it is empty, the model's own drive
// or else the guessed one is used. If there is none, only joints and sensors are used. Returns the
// same model if nothing changes. Returns kBadModel if the model lacks the chosen joints, or if
// there is no choice and it has no drive, wheels, movable joints or sensors.
[[nodiscard]] base::Result<std::shared_ptr<const Model>> AsRobot(std::shared_ptr<const Model> model,
                                                                 const std::string& choice);

// Returns, for example, "differential, guessed from wheels left_wheel, right_wheel; radius 0.1 m,
// separation 0.4 m". The model must have a drive.
std::string DescribeDrive(const Model& model);

}  // namespace gsv::model
