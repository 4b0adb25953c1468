// Behaviours that run inside this process, by name.
#pragma once

#include <memory>
#include <string>

#include "gsv/base/error.h"
#include "gsv/simulation/behaviour_port.h"

namespace gsv::app {

// From the plug-in gsv-NAME.so in ../lib/gsv beside this program's folder, or in a folder of
// GSV_PLUGIN_PATH (separated by colons). `behaviour` is a name and, after blanks, its options. One
// instance: for one robot.
base::Result<std::shared_ptr<simulation::BehaviourPort>> InProcessBehaviour(
    const std::string& behaviour);

}  // namespace gsv::app
