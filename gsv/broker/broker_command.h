// The command `gsv broker`: serves a broker until it is stopped.
#pragma once

#include <sys/types.h>

#include "gsv/broker/broker.h"
#include "gsv/broker/transport/process_limits.h"

namespace gsv::broker {

struct BrokerCommand {
  BrokerOptions broker;   // address, limits and data file
  ProcessLimits process;  // limits on memory and file descriptors of this process
  // This process ends when `parent` ends; 0 for no parent. The kernel watches the thread (not the
  // process) that started this process. So this thread should live as long as the parent process.
  pid_t parent = 0;
};

// Prints the reference as one line on stdout. Then serves requests until SIGINT, SIGTERM or SIGHUP,
// or until `parent` ends. The process must have no other thread. Returns the exit code, or ends
// the process with it: 0 normally; 130 after SIGINT; 2 for an invalid argument; 5 after any other
// error. Errors are printed on stderr.
int BrokerMain(const BrokerCommand& command);

}  // namespace gsv::broker
