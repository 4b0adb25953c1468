// Reads the drive in a model's plugin element.
#pragma once

#include <optional>

#include <sdf/Element.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Reads the drive of a <plugin>: DiffDrive (Gazebo, Gazebo Classic and gazebo_ros), skid steering,
// Ackermann, mecanum, VelocityControl, planar move, TrackedVehicle, or GSV's own gsv-synchro-drive
// with optional <wheel_joint> and <wheel_radius>. All have optional limits
// max/min_[linear_|angular_](velocity|acceleration) and <command_timeout> (seconds). Returns
// nullopt for any other plugin.
//
// Joint names refer to `model`, below `scope` ("" or "inner::"). If the file does not give the
// wheels' separation, radius or wheel base, they are measured on the wheels' collision shapes.
// Without such shapes, the distances are measured between the wheels' joints. If a drive names
// missing joints, or no wheels, it is guessed instead (model/drive_guess.h), with a warning.
// AckermannSteering with <steering_only> names no wheels, so the drive is guessed. If there are no
// wheels, the base does not move and its joints take commands.
std::optional<model::Drive> ReadDrive(const sdf::ElementPtr& plugin, const model::Model& model,
                                      const std::string& scope, const ReadingContext& context);

}  // namespace gsv::formats
