// Offers a behaviour through the broker: what the main() of a behaviour program calls.
#pragma once

#include <functional>
#include <string>

#include "sdk/behaviour/behaviour.h"

namespace CLI {
class App;
}

namespace gsv {

struct BehaviourProgram {
  std::string name;         // the offer's: "wander"
  std::string description;  // one line for --help
  // Adds the program's own options; may be empty.
  std::function<void(CLI::App&)> add_options;
  // It tells the time by the robot's clock only, so that a simulation may wait for it.
  bool time_managed = true;
};

// Reads the command line (--broker REF, --name NAME, --help), offers a factory of behaviours, and
// serves until SIGINT or SIGTERM. Gives the program's exit code: 0, 2 for a usage error, 5 when
// the broker cannot be reached.
int ServeBehaviour(int argc, char** argv, const BehaviourProgram& program,
                   BehaviourFactory factory);

}  // namespace gsv
