// Reads what a model's own controllers tell its joints from the start: Gazebo's JointController
// and JointPositionController plugins.
//
// Elements  <joint_name> (several, in newer files), <initial_velocity> and <initial_position>. Of a
//           position controller <cmd_max> bounds the joint's effort and, with
//           <use_velocity_commands>, its velocity. Gains are not read: our servo has its own, see
//           docs/fidelity.md.
#pragma once

#include <string>
#include <vector>

#include <sdf/Element.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Adds to `model` what `plugin` says; nothing if it is no such controller. `scope` is that of the
// names in it ("inner::").
void ReadJointTargets(const sdf::ElementPtr& plugin, const std::string& scope,
                      const ReadingContext& context, model::Model& model);

}  // namespace gsv::formats
