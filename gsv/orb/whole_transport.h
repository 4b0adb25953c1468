// omniORB's own transports, TCP and sockets in the file system, with connections of clients that
// hand on whole messages only (whole_messages.h).
#pragma once

#include "gsv/orb/whole_messages.h"

namespace gsv::orb {

// For this process's ORB. Call it before each ORB_init(); the limits hold for connections that are
// made from now on.
void InstallWholeTransports(const MessageLimits& limits);
// Those of the last call, for other transports. Any thread.
MessageLimits CurrentMessageLimits();

}  // namespace gsv::orb
