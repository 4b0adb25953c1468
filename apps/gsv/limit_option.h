// --limit, of every command that reads worlds and models.
#pragma once

#include "apps/gsv/server_limits.h"
#include "gsv/formats/read_limits.h"

namespace CLI {
class App;
}

namespace gsv::app {

// `limits` outlives the parsing.
void AddLimitOption(CLI::App& command, formats::ReadLimits& limits);
// The same, where simulations are served.
void AddLimitOption(CLI::App& command, formats::ReadLimits& limits, ServerLimits& server);

}  // namespace gsv::app
