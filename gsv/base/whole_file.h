// Files that others find whole or not at all.
//
// Threads  any; two that write the same file at once want two processes.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string_view>

#include "gsv/base/error.h"

namespace gsv::base {

// What the file is to outlive once it is written.
enum class Outlives { kProcess, kPowerCut };  // the latter waits for the disk

// Writes a draft beside `file` and renames it into place. kUnavailable when it can't be written;
// the draft is gone then, and what was there before stays.
Status WriteWhole(const std::filesystem::path& file, std::string_view text, Outlives outlives);

// Where process `pid` drafts `file`: what is left there is of one that was killed as it wrote.
std::filesystem::path DraftOf(const std::filesystem::path& file, pid_t pid);

}  // namespace gsv::base
