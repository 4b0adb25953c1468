// Where this user's processes on this machine find each other.
//
// Threads  any.
#pragma once

#include <filesystem>

#include "gsv/base/error.h"

namespace gsv::base {

// $XDG_RUNTIME_DIR/gsv, or /tmp/gsv-UID where there is no such variable; made when it is not there.
// Fails when it can't be, or when others may write to it: anybody may make a folder in /tmp.
Result<std::filesystem::path> UserFolder();

}  // namespace gsv::base
