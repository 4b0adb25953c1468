// Writes files atomically: readers find the complete file or the previous one.
//
// Threads  any, but only one per process may write the same file at a time.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string_view>

#include "gsv/base/error.h"

namespace gsv::base {

// The event that a written file must survive: the end of the process, or a power failure.
enum class Durability { kProcess, kPowerLoss };  // kPowerLoss waits until the disk has the data

// Writes a temporary file beside `file` and renames it. Returns kUnavailable if the file cannot be
// written; the previous file stays, and no temporary file remains.
Status WriteAtomically(const std::filesystem::path& file, std::string_view text,
                       Durability durability);

// The temporary file that process `pid` uses for `file`. The temporary file remains only if the
// process was killed while it wrote this file.
std::filesystem::path DraftPath(const std::filesystem::path& file, pid_t pid);

}  // namespace gsv::base
