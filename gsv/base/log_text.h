// What a message becomes in the log.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gsv::base {

// On one line: control characters and what is not UTF-8 are written as \n, \t, \xNN. Cut off at
// `max_bytes`, with the number of bytes that are missing. `secrets` are replaced by "(hidden)".
std::string LogLine(std::string_view message, std::size_t max_bytes,
                    const std::vector<std::string>& secrets);

// Between quotes, as JSON has it; `line` comes from LogLine().
std::string JsonText(std::string_view line);

}  // namespace gsv::base
