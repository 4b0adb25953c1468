// Three robots in the playground, driven by three programs of two behaviours: the run whose hash
// must come out the same whatever happens to the programs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/programs.h"

namespace gsv::testing {

inline constexpr double kFleetSeconds = 0.6;  // twelve control cycles

// What is done to the programs.
struct Handicap {
  std::vector<std::string> wrapper;  // see Running
  bool in_reverse_order = false;
};

// The programs, offered at a broker.
class Fleet {
 public:
  explicit Fleet(const std::string& broker, const Handicap& handicap = {});
  Running& program(int number) { return *programs_[number]; }

 private:
  std::vector<std::unique_ptr<Running>> programs_;
};

// The command line of `gsv run` with such robots; `more` is added to it.
std::vector<std::string> FleetRun(const std::string& broker, std::vector<std::string> more = {});

}  // namespace gsv::testing
