// Reads the initial targets of joints from a model's controllers: Gazebo's JointController and
// JointPositionController plugins.
//
// Elements  <joint_name> (several, in newer files), <initial_velocity> and <initial_position>. For
//           a position controller, <cmd_max> limits the joint's effort and, with
//           <use_velocity_commands>, its velocity. Gains are not read: gsv's servo has its own, see
//           docs/fidelity.md.
#pragma once

#include <string>
#include <vector>

#include <sdf/Element.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Adds the targets in `plugin` to `model`; ignores other plugins. `scope` is that of the names in
// it ("inner::").
void ReadJointTargets(const sdf::ElementPtr& plugin, const std::string& scope,
                      const ReadingContext& context, model::Model& model);

}  // namespace gsv::formats
