// The option --limit of commands that read worlds and models.
#pragma once

#include "apps/gsv/serving/server_limits.h"
#include "gsv/formats/files/read_limits.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace gsv::app {

// Adds --limit. `limits` must outlive the parsing.
CLI::Option* AddLimitOption(CLI::App& command, formats::ReadLimits& limits);
// Adds --limit for commands that serve simulations, whose server has further limits.
CLI::Option* AddLimitOption(CLI::App& command, formats::ReadLimits& limits, ServerLimits& server);

}  // namespace gsv::app
