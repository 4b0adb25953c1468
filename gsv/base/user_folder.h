// The folder whose files let this user's processes on this machine find each other.
//
// Threads  any.
#pragma once

#include <filesystem>

#include "gsv/base/error.h"

namespace gsv::base {

// Returns $XDG_RUNTIME_DIR/gsv, or /tmp/gsv-UID if that variable is not set or no absolute path.
// Creates the folder if it does not exist. Fails if the folder cannot be created. Anybody may create
// folders in /tmp, so the function also fails if another user owns the folder or may write to it.
Result<std::filesystem::path> UserFolder();

}  // namespace gsv::base
