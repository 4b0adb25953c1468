#include "tests/end_to_end/fleet.h"

#include <algorithm>

namespace gsv::testing {

Fleet::Fleet(const std::string& broker, const Handicap& handicap) {
  std::vector<std::string> names{"gsv-wander", "gsv-wander", "gsv-follow-wall"};
  if (handicap.in_reverse_order) std::reverse(names.begin(), names.end());
  for (const std::string& name : names) {
    programs_.push_back(std::make_unique<Running>(
        name, std::vector<std::string>{"--broker", broker}, handicap.wrapper));
    programs_.back()->AwaitLine("offered at");
  }
}

std::vector<std::string> FleetRun(const std::string& broker, std::vector<std::string> more) {
  std::vector<std::string> arguments{"run",
                                     "playground",
                                     "--broker",
                                     broker,
                                     "--behaviour",
                                     "wander",
                                     "--behaviour",
                                     "pebble_3=follow-wall",
                                     "--lockstep",
                                     "--duration",
                                     std::to_string(kFleetSeconds),
                                     "--seed",
                                     "7",
                                     "--headless",
                                     "--json"};
  for (const char* robot : {"pebble@-1.2,0", "pebble@0,0", "pebble@1.2,0"}) {
    arguments.push_back("--robot");
    arguments.push_back(robot);
  }
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

}  // namespace gsv::testing
