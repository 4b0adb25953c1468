// Reads the initial targets and the gains of joints from a model's controllers: gz-sim's
// JointController and JointPositionController, and JointControlPlugin of Gazebo classic
// (sdf_classic_control.h).
//
// Elements  <joint_name> (several, in newer files), <initial_velocity> or <initial_position>, and
//           the gains of a PID controller: <p_gain>, <i_gain>, <d_gain>, <i_max>, <i_min>,
//           <cmd_max>, <cmd_min>, <cmd_offset>. As in Gazebo, a velocity controller uses the gains
//           only with <use_force_commands>. A position controller uses the gains unless it has
//           <use_velocity_commands>; then <cmd_max> limits the velocity instead. A position
//           controller without any gain keeps GSV's own servo, see docs/fidelity.md; <cmd_max>
//           limits its effort.
#pragma once

#include <string>
#include <vector>

#include <sdf/Element.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Adds the targets in `plugin` to `model`; ignores other plugins. `scope` is the prefix of the
// names in the plugin ("inner::").
void ReadJointTargets(const sdf::ElementPtr& plugin, const std::string& scope,
                      const ReadingContext& context, model::Model& model);

// Returns the joint that a controller names. If the joint takes no commands or does not exist, adds
// a warning with the reason and returns null.
model::Joint* FindControlledJoint(const std::string& name, const std::string& place,
                                  const ReadingContext& context, model::Model& model);

// Sets the target of a joint. If the joint already has a target, adds a warning, and uses the new
// target.
void SetTarget(const model::JointTarget& target, const std::string& place,
               const ReadingContext& context, model::Model& model);

// Replaces negative gains by 0, with a warning. With negative gains, a joint would move away from
// its target.
model::JointGains WithoutNegatives(model::JointGains gains, const std::string& place,
                                   const ReadingContext& context);

}  // namespace gsv::formats
