// Finds the running gsv processes of this user, and the addresses of their brokers. There is one
// small file for each process, in $XDG_RUNTIME_DIR/gsv or, if that is not set, /tmp/gsv-UID.
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

// Returns the start time of a process, in clock ticks since the machine was booted. Returns nullopt
// if there is no process with that number.
std::optional<std::uint64_t> ProcessStart(pid_t pid);

// A running gsv process of this user.
struct Instance {
  pid_t pid = 0;
  // start of the process, in clock ticks since the machine was booted; detects a reused pid
  std::uint64_t started = 0;
  std::string broker;  // the reference of its broker
};

// The file of this process. The destructor removes it.
class InstanceRecord {
 public:
  // Fails if the folder cannot be written, or if other users can write to it.
  static base::Result<std::unique_ptr<InstanceRecord>> Write(const std::string& broker);
  ~InstanceRecord();
  InstanceRecord(const InstanceRecord&) = delete;
  InstanceRecord& operator=(const InstanceRecord&) = delete;

 private:
  explicit InstanceRecord(std::filesystem::path file) : file_(std::move(file)) {}

  const std::filesystem::path file_;
};

// Returns the instances, the newest first. Removes the files of processes that have ended.
std::vector<Instance> RunningInstances();

}  // namespace gsv::app
