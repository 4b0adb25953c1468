// Behaviours in shared libraries, gsv-NAME.so: what is offered as a program can run inside gsv too.
// A library that is loaded stays loaded, and is trusted: its faults are this process's.
//
// Threads  any.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "sdk/behaviour/module.h"

namespace gsv::hosting {

// The file of the behaviour in the first of these folders that holds one; empty if none does.
std::string FindPlugin(const std::string& behaviour, const std::vector<std::string>& folders);

// Fails when the file is no library, no behaviour, or built against another version of gsv.
base::Result<const BehaviourModule*> LoadPlugin(const std::string& file);

}  // namespace gsv::hosting
