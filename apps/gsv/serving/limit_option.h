// --limit, of every command that reads worlds and models.
#pragma once

#include "apps/gsv/serving/server_limits.h"
#include "gsv/formats/files/read_limits.h"

namespace CLI {
class App;
}

namespace gsv::app {

// `limits` outlives the parsing.
void AddLimitOption(CLI::App& command, formats::ReadLimits& limits);
// The same, where simulations are served.
void AddLimitOption(CLI::App& command, formats::ReadLimits& limits, ServerLimits& server);

}  // namespace gsv::app
