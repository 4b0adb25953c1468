// The program's log: one line per event on stderr, with a limited rate.
//
// Text    12:03:04.567 warning: text
// JSON    {"time":"2024-05-06T12:03:04.567Z","level":"warning","message":"text","pid":1,"thread":2}
// Lines     one per message: control characters are escaped as \n, \t, \x1b.
// Bounded   the length of lines, and their rate (see LogRateLimiter). The log reports how many
//           lines it suppressed.
// Secrets   texts that are registered with RedactInLog() are replaced in every message.
// Threads   any, except for InitLogging().
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <spdlog/spdlog.h>

#include "gsv/base/error.h"

// libfmt exports this function. Without the declaration, all of fmt would be compiled again in each
// file that logs. Clang gives the function another symbol, which libfmt does not export.
#ifndef __clang__
extern template void fmt::detail::vformat_to<char>(fmt::detail::buffer<char>&, fmt::string_view,
                                                   fmt::format_args, fmt::detail::locale_ref);
#endif

namespace gsv::base {

enum class LogFormat { kText, kJson };

// The level, the format and the limits of the log.
struct LogOptions {
  spdlog::level::level_enum level = spdlog::level::warn;
  LogFormat format = LogFormat::kText;
  std::size_t lines_per_second = 20;  // mean rate; a burst may have 50 times this number
  std::size_t line_bytes = 8192;      // maximum length of a message; a longer message is truncated
};

// Parses "trace", "debug", "info", "warning", "error" or "off". Other text is a kInvalidArgument
// error that lists these words.
Result<spdlog::level::level_enum> ParseLogLevel(const std::string& text);
// Parses "text" or "json".
Result<LogFormat> ParseLogFormat(const std::string& text);

// Reads the options from the variables GSV_LOG_LEVEL and GSV_LOG_FORMAT. `level` is used if
// GSV_LOG_LEVEL is not set or has an invalid value.
LogOptions LogOptionsFromEnvironment(spdlog::level::level_enum level);

// Makes this log spdlog's default logger. Call it once, in main().
void InitLogging(const LogOptions& options);
inline void InitLogging(spdlog::level::level_enum level) {
  InitLogging(LogOptionsFromEnvironment(level));
}

// Replaces `secret` in all later messages.
void RedactInLog(const std::string& secret);

// Line counts since the process started.
struct LogCounts {
  std::uint64_t written = 0;     // lines that were printed
  std::uint64_t suppressed = 0;  // lines beyond the rate limit, which were not printed
};
LogCounts ProcessLogCounts();

}  // namespace gsv::base
