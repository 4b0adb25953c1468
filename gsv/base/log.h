// The program's log: one line an event, on stderr.
#pragma once

#include <spdlog/spdlog.h>

namespace gsv::base {

// Sends spdlog's default logger to stderr as "12:03:04.567 warning: text". Call once in main().
void InitLogging(spdlog::level::level_enum level);

}  // namespace gsv::base
