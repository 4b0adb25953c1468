// Offers a behaviour through the broker: what the main() of a behaviour program calls.
#pragma once

#include "sdk/behaviour/module.h"

namespace gsv {

// Reads the command line (--broker REF, --name NAME, --help), offers a factory of behaviours, and
// serves until SIGINT, SIGTERM or SIGHUP; a second one ends it at once. Gives the program's exit code: 0, 2 for a usage error, 5 when
// the broker cannot be reached.
int ServeBehaviour(int argc, char** argv, const BehaviourModule& module);

}  // namespace gsv
