// --limit, of every command that reads worlds and models.
#pragma once

#include "apps/gsv/serving/server_limits.h"
#include "gsv/formats/files/read_limits.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gsv::app {

// `limits` outlives the parsing.
CLI::Option* AddLimitOption(CLI::App& command, formats::ReadLimits& limits);
// The same, where simulations are served.
CLI::Option* AddLimitOption(CLI::App& command, formats::ReadLimits& limits, ServerLimits& server);

}  // namespace gsv::app
