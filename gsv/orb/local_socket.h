// A socket of the file system for calls between this user's processes on one machine: a call takes
// two thirds of the time that it takes by TCP on loopback (docs/performance.md). A reference names
// both ways; who is on another host, in another container or another user, comes by TCP.
//
// Threads  any.
#pragma once

#include <filesystem>

#include "gsv/base/error.h"

namespace gsv::orb {

// A name that is not taken, below base::UserFolder(). Removes what processes left there that ended
// without doing so. Fails where there is no such folder, or its name is too long for a socket.
base::Result<std::filesystem::path> NewLocalSocket();

}  // namespace gsv::orb
