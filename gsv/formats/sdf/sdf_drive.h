// The drive a model's plugin element asks for.
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
// Joints are those of `model`, named within `scope` ("" or "inner::"). Separation, radius and wheel
// base that the file leaves out are measured: between the wheel's joints, and on the collision
// shapes of the wheels. A joint that is not there is an error.
std::optional<model::Drive> ReadDrive(const sdf::ElementPtr& plugin, const model::Model& model,
                                      const std::string& scope, const ReadingContext& context);

// Of a model without any such plugin: two wheels side by side, on joints that turn without limit
// about one axis across the model, are a differential drive. Robot descriptions made for other
// programs say no more than that. None for anything else.
std::optional<model::Drive> GuessDifferentialDrive(const model::Model& model);

}  // namespace gsv::formats
