// Reads the logs of real robots. docs/formats/logs.md describes the formats.
//
// Input   untrusted, see text_rows.h. `problems` gets a warning, with file and line, for each row
//         that is skipped.
// Errors  kNotFound for a missing file, kCorrupt for an unusable file, kInvalidArgument for an
//         unknown format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gsv/reality/logs/log.h"

namespace gsv::reality {

// Returns the names of the formats in the order in which the help lists them.
std::vector<std::string> LogFormats();

// Detects the format of a log from its file name, or else from its first lines. Fails with
// kInvalidArgument if the format cannot be detected.
base::Result<std::string> GuessLogFormat(const std::filesystem::path& path);

// Reads a log. If the format has several files, `path` is the file that docs/formats/logs.md lists
// first, and the others must be in the same folder.
base::Result<Log> ReadLog(const std::filesystem::path& path, const std::string& format,
                          base::Problems& problems);

// These functions read one format each. The other files of the log must be in the folder of `path`.
base::Result<Log> ReadSonarRing(const std::filesystem::path& path, base::Problems& problems);
base::Result<Log> ReadArena(const std::filesystem::path& path, base::Problems& problems);
base::Result<Log> ReadMrclam(const std::filesystem::path& path, base::Problems& problems);
base::Result<Log> ReadRobotData(const std::filesystem::path& path, base::Problems& problems);
base::Result<Log> ReadCarmen(const std::filesystem::path& path, base::Problems& problems);
base::Result<Log> ReadUwb(const std::filesystem::path& path, base::Problems& problems);
base::Result<Log> ReadMcap(const std::filesystem::path& path, base::Problems& problems);

}  // namespace gsv::reality
