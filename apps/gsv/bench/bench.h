// The benches of `gsv bench`: each adds its subcommand. All but the broker's run the step loop of
// `gsv run`.
#pragma once

#include "apps/gsv/commands.h"

namespace gsv::app {

void AddTypicalBench(const CommandLine& bench);
void AddLockstepBench(const CommandLine& bench);
void AddCrowdBench(const CommandLine& bench);
void AddBrokerBench(const CommandLine& bench);
void AddCameraBench(const CommandLine& bench);

}  // namespace gsv::app
