// For tests: three robots in the playground, driven by three programs of two behaviours. The hash
// of the run must be the same if the programs are slowed down, paused or delayed.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/programs.h"

namespace gsv::testing {

inline constexpr double kFleetSeconds = 0.6;  // twelve control cycles

// The disturbances of the programs.
struct Handicap {
  std::vector<std::string> wrapper;  // command line such as {"nice"}; see class Running
  bool in_reverse_order = false;
};

// The programs of the behaviours, which are offered at a broker.
class Fleet {
 public:
  explicit Fleet(const std::string& broker, const Handicap& handicap = {});
  Running& program(int number) { return *programs_[number]; }

 private:
  std::vector<std::unique_ptr<Running>> programs_;
};

// Returns the command line of `gsv run` with the robots of a Fleet, followed by `more`.
std::vector<std::string> FleetRun(const std::string& broker, std::vector<std::string> more = {});

}  // namespace gsv::testing
