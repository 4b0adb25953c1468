// The program's log: one line an event, on stderr, in a bounded volume.
//
// Text    12:03:04.567 warning: text
// JSON    {"time":"2024-05-06T12:03:04.567Z","level":"warning","message":"text","pid":1,"thread":2}
// One line  whatever a message holds: control characters are written as \n, \t, \x1b.
// Bounded   lines of a length, and so many a second (see LogRateLimiter); what was left out is counted
//           and told.
// Secrets   that were hidden are replaced wherever they occur.
// Threads   any, but for InitLogging().
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <spdlog/spdlog.h>

#include "gsv/base/error.h"

namespace gsv::base {

enum class LogFormat { kText, kJson };

struct LogOptions {
  spdlog::level::level_enum level = spdlog::level::warn;
  LogFormat format = LogFormat::kText;
  std::size_t lines_per_second = 20;  // in the long run; fifty times as many at once
  std::size_t line_bytes = 8192;      // of a message; the rest is cut off
};

// trace, debug, info, warning, error, off. kInvalidArgument, naming them: none of these.
Result<spdlog::level::level_enum> ParseLogLevel(const std::string& text);
// text, json.
Result<LogFormat> ParseLogFormat(const std::string& text);

// As the variables GSV_LOG_LEVEL and GSV_LOG_FORMAT say; `level` where they say nothing, or
// nonsense.
LogOptions LogOptionsFromEnvironment(spdlog::level::level_enum level);

// Makes spdlog's default logger this log. Call once in main().
void InitLogging(const LogOptions& options);
inline void InitLogging(spdlog::level::level_enum level) {
  InitLogging(LogOptionsFromEnvironment(level));
}

// From now on nothing that is logged shows `secret`.
void RedactInLog(const std::string& secret);

// Since the process started.
struct LogCounts {
  std::uint64_t written = 0;
  std::uint64_t suppressed = 0;
};
LogCounts ProcessLogCounts();

}  // namespace gsv::base
