// Lets users choose the drive of a robot, and makes a robot of any model.
//
// A choice is a text with the same form on the command line, in scenarios and in recordings:
//
//   KIND[,KEY=VALUE]…   diff,left=front_left,left=rear_left,right=front_right,right=rear_right
//
// KIND      diff or skid (differential), ackermann, mecanum, omni (follows any velocity), none.
// KEY       left, right: a joint that turns a wheel; steer: a joint that steers. Each of these keys
//           may occur several times, or once with several joints joined by "+". radius, separation,
//           wheel_base in metres, steering_limit in radians.
// If the model's own drive has that kind, values that are not given are its values; but if joints
// are given, lengths and limits are measured. With another kind, values that are not given are
// guessed and measured (drive_guess.h).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/model.h"

namespace gsv::model {

// A parsed choice of a drive.
struct DriveChoice {
  DriveKind kind = DriveKind::kNone;
  std::vector<std::string> left, right, steer;  // names of the joints
  // The values of the keys with these names, in m and rad; nullopt if the choice does not set the
  // key.
  std::optional<double> radius, separation, wheel_base, steering_limit;
};

// Parses a choice. Fails with kInvalidArgument and describes the expected form.
[[nodiscard]] base::Result<DriveChoice> ParseDriveChoice(const std::string& text);

// Returns the model as a robot. `choice` is a text as above, or empty for the model's own drive or
// a guessed drive. If no drive can be guessed either, the robot only has joints and sensors.
// Returns the same model if nothing changes. Fails with kInvalidArgument for an invalid choice. Fails
// with kBadModel if the model lacks the chosen joints or the wheels of the chosen drive. If `choice`
// is empty, fails with kBadModel if the model has no drive, wheels, movable joints or sensors.
[[nodiscard]] base::Result<std::shared_ptr<const Model>> AsRobot(std::shared_ptr<const Model> model,
                                                                 const std::string& choice);

// Returns a description such as "differential, guessed from wheels left_wheel, right_wheel; radius
// 0.1 m, separation 0.4 m". The model must have a drive.
std::string DescribeDrive(const Model& model);

}  // namespace gsv::model
