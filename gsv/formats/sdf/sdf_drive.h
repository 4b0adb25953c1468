// Reads the drive in a model's plugin element.
#pragma once

#include <optional>

#include <sdf/Element.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// From a <plugin>: DiffDrive (Gazebo, Gazebo Classic and gazebo_ros), skid steering, Ackermann,
// mecanum, VelocityControl, and this program's own gsv-synchro-drive, which may name its wheels in
// <wheel_joint> and take <wheel_radius>. All take max/min_[linear_|angular_](velocity|
// acceleration) and <command_timeout> (seconds). None for any other plugin.
//
// Joints are those of `model`, named within `scope` ("" or "inner::"). If the file leaves out
// separation, radius or wheel base, they are measured: between the wheels' joints, and on the
// collision shapes of the wheels. A drive that names missing joints, or no wheels, is guessed
// instead (model/drive_guess.h), with a warning. AckermannSteering with <steering_only> names no
// wheels: they are guessed; without any, the base does not move and its joints take commands.
std::optional<model::Drive> ReadDrive(const sdf::ElementPtr& plugin, const model::Model& model,
                                      const std::string& scope, const ReadingContext& context);

}  // namespace gsv::formats
