// The main() of a behaviour program: offers the behaviour through the broker.
#pragma once

#include "sdk/behaviour/module.h"

namespace gsv {

// Reads the command line (--broker REF, --name NAME, --help, and the behaviour's options), offers a
// factory of behaviours, and serves until SIGINT, SIGTERM or SIGHUP. A second signal ends the
// process at once. Returns the exit code: 0, 2 for a usage error, 5 if the broker cannot be
// reached.
int ServeBehaviour(int argc, char** argv, const BehaviourModule& module);

}  // namespace gsv
