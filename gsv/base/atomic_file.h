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
enum class Durability { kProcess, kPowerLoss };  // the latter waits for the disk

// Writes a draft beside `file` and renames it into place. kUnavailable when it can't be written;
// the draft is gone then, and what was there before stays.
Status WriteAtomically(const std::filesystem::path& file, std::string_view text,
                       Durability durability);

// Where process `pid` drafts `file`: what is left there is of one that was killed as it wrote.
std::filesystem::path DraftPath(const std::filesystem::path& file, pid_t pid);

}  // namespace gsv::base
