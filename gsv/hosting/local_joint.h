// Implements a robot's joint for a behaviour in this process.
//
// Threads  only the thread that executes the behaviour's turn.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/hosting/local_robot.h"

namespace gsv::hosting {

std::vector<JointTraits> TraitsOf(const std::vector<model::Joint>& joints);

// `robot` must outlive the joint. Returns kNotFound if no joint with that name takes commands.
base::Result<std::unique_ptr<Joint>> MakeLocalJoint(LocalRobot& robot,
                                                    const std::vector<model::Joint>& joints,
                                                    const std::string& name);

}  // namespace gsv::hosting
