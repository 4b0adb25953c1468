// Reads <ros2_control>: the joints of a robot with their command and state interfaces.
//
// Source  ros2_control, "Hardware components" of its documentation.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include <tinyxml2.h>

#include "gsv/base/error.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Reads the <ros2_control> children of `element` (<robot>, or <model>). A joint that `model` does
// not have is left out with a warning.
std::vector<model::ControlSystem> ReadControlSystems(const tinyxml2::XMLElement& element,
                                                     const std::filesystem::path& file,
                                                     const model::Model& model,
                                                     base::Problems& problems);

// Returns a copy of `model` with the control systems that ReadControlSystems() reads from
// `element`. If there are none, returns `model` itself.
std::shared_ptr<const model::Model> WithControlSystems(const tinyxml2::XMLElement& element,
                                                       const std::filesystem::path& file,
                                                       std::shared_ptr<const model::Model> model,
                                                       base::Problems& problems);

}  // namespace gsv::formats
