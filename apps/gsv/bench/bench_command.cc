#include <CLI/CLI.hpp>

#include "apps/gsv/bench/bench.h"

namespace gsv::app {

void AddBenchCommands(const CommandLine& line) {
  CLI::App* bench = line.app.add_subcommand("bench", "Measure the performance of this machine");
  bench->require_subcommand(1);
  const CommandLine inner{*bench, line.signals, line.exit_code};
  AddTypicalBench(inner);
  AddLockstepBench(inner);
  AddCrowdBench(inner);
  AddBrokerBench(inner);
  AddCameraBench(inner);
  AddLidarBench(inner);
  AddRigidBench(inner);
}

}  // namespace gsv::app
