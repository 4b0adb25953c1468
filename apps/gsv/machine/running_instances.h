// Which gsv processes of this user can be asked, and through which broker: one small file for each,
// in $XDG_RUNTIME_DIR/gsv or, without that, /tmp/gsv-UID.
//
// Threads  any.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::app {

// When a process was started, in clock ticks after the machine's start; nothing when there is none
// of that number.
std::optional<std::uint64_t> ProcessStart(pid_t pid);

struct Instance {
  pid_t pid = 0;
  std::uint64_t started = 0;  // clock ticks after the machine's start; tells a reused pid
  std::string broker;         // its reference
};

// This process's file; it goes when this does.
class InstanceRecord {
 public:
  // Fails when the folder cannot be written, or is not this user's alone.
  static base::Result<std::unique_ptr<InstanceRecord>> Write(const std::string& broker);
  ~InstanceRecord();
  InstanceRecord(const InstanceRecord&) = delete;
  InstanceRecord& operator=(const InstanceRecord&) = delete;

 private:
  explicit InstanceRecord(std::filesystem::path file) : file_(std::move(file)) {}

  const std::filesystem::path file_;
};

// The newest first. Files of processes that have ended are ignored, and removed.
std::vector<Instance> RunningInstances();

}  // namespace gsv::app
