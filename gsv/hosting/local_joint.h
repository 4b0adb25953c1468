// A joint of a robot that a behaviour inside this process drives.
//
// Threads  the thread that takes the behaviour's turn.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/hosting/local_robot.h"

namespace gsv::hosting {

std::vector<JointTraits> TraitsOf(const std::vector<model::Joint>& joints);

// `robot` outlives it. kNotFound when no joint of that name takes commands.
base::Result<std::unique_ptr<Joint>> MakeLocalJoint(LocalRobot& robot,
                                                    const std::vector<model::Joint>& joints,
                                                    const std::string& name);

}  // namespace gsv::hosting
