// `gsv rec list`: the recordings in a folder, with world, robots and verdict.
#pragma once

#include "apps/gsv/commands/commands.h"

namespace gsv::app {

void AddRecordingListCommand(const CommandLine& line, CLI::App& rec);

}  // namespace gsv::app
