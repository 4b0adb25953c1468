// Loads behaviours by name that run in this process.
#pragma once

#include <memory>
#include <string>

#include "gsv/base/error.h"
#include "gsv/simulation/behaviour_port.h"

namespace gsv::app {

// Loads the plug-in gsv-NAME.so from ../lib/gsv beside this program's folder, or from a folder in
// GSV_PLUGIN_PATH (separated by colons). `behaviour` is a name. The behaviour's options may follow
// after spaces. Returns an instance of the behaviour for one robot.
base::Result<std::shared_ptr<simulation::BehaviourPort>> InProcessBehaviour(
    const std::string& behaviour);

}  // namespace gsv::app
