// Reads the joint controllers of Gazebo Classic's JointControlPlugin.
//
// Elements  <controller type="position", "velocity" or "force"> with <joint>, <target> and, for
//           "position" and "velocity", <pid_gains>: three numbers.
#pragma once

#include <string>

#include <sdf/Element.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Adds the targets and gains in `plugin` to `model`; ignores other plugins. `scope` is the prefix
// of the names in the plugin ("inner::").
void ReadClassicControl(const sdf::ElementPtr& plugin, const std::string& scope,
                        const ReadingContext& context, model::Model& model);

}  // namespace gsv::formats
