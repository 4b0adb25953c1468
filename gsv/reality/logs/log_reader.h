// Reads the logs of real robots. docs/formats/logs.md describes the formats.
//
// Input   untrusted, see text_rows.h. What is left out is a warning in `problems`, with file and
//         line.
// Errors  kNotFound for a file that is not there, kCorrupt for one that cannot be used,
//         kInvalidArgument for a format that is unknown.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gsv/reality/logs/log.h"

namespace gsv::reality {

// In the order in which help lists them.
std::vector<std::string> LogFormats();

// The format of a log, by the name of its file and, for *.log, its first lines. kInvalidArgument if
// they do not show it.
base::Result<std::string> GuessLogFormat(const std::filesystem::path& path);

// `path` is the file that the format names first; its companions are found beside it.
base::Result<Log> ReadLog(const std::filesystem::path& path, const std::string& format,
                          base::Problems& problems);

// Each format. The companions of `path` are found beside it.
base::Result<Log> ReadSonarRing(const std::filesystem::path& path, base::Problems& problems);
base::Result<Log> ReadArena(const std::filesystem::path& path, base::Problems& problems);
base::Result<Log> ReadMrclam(const std::filesystem::path& path, base::Problems& problems);
base::Result<Log> ReadRobotData(const std::filesystem::path& path, base::Problems& problems);
base::Result<Log> ReadCarmen(const std::filesystem::path& path, base::Problems& problems);
base::Result<Log> ReadUwb(const std::filesystem::path& path, base::Problems& problems);
base::Result<Log> ReadMcap(const std::filesystem::path& path, base::Problems& problems);

}  // namespace gsv::reality
