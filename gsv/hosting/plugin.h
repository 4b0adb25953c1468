// Loads behaviours from shared libraries, gsv-NAME.so, which can run as programs or inside gsv. A
// library stays loaded. Plug-ins are trusted: a crash in a plug-in ends this process.
//
// Threads  any.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "sdk/behaviour/module.h"

namespace gsv::hosting {

// Returns the path of the behaviour's file (gsv-NAME.so) in the first of `folders` that contains
// this file. Returns an empty text if no folder contains this file.
std::string FindPlugin(const std::string& behaviour, const std::vector<std::string>& folders);

// Fails if the file is not a library, if it is not a behaviour, or if it was built for another
// version of gsv.
base::Result<const BehaviourModule*> LoadPlugin(const std::string& file);

}  // namespace gsv::hosting
