// --limit, of every command that reads worlds and models.
#pragma once

#include "gsv/formats/read_limits.h"

namespace CLI {
class App;
}

namespace gsv::app {

// `limits` outlives the parsing.
void AddLimitOption(CLI::App& command, formats::ReadLimits& limits);

}  // namespace gsv::app
