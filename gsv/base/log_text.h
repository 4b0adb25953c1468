// Formats messages for the log.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gsv::base {

// Returns the message as one line: control characters and invalid UTF-8 are escaped as \n, \t,
// \xNN. A longer line is truncated to `max_bytes`, followed by the number of missing bytes. Each of
// `secrets` is replaced by "(hidden)".
std::string LogLine(std::string_view message, std::size_t max_bytes,
                    const std::vector<std::string>& secrets);

// Returns the line as a JSON string in quotes. `line` comes from LogLine().
std::string JsonText(std::string_view line);

}  // namespace gsv::base
