// The gsv processes of this user and their brokers: one small file for each process, in
// $XDG_RUNTIME_DIR/gsv or, if that is not set, /tmp/gsv-UID.
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

// The start time of a process, in clock ticks after the machine's start; nothing if there is no
// process of that number.
std::optional<std::uint64_t> ProcessStart(pid_t pid);

struct Instance {
  pid_t pid = 0;
  std::uint64_t started = 0;  // clock ticks after the machine's start; detects a reused pid
  std::string broker;         // its reference
};

// This process's file, which the destructor removes.
class InstanceRecord {
 public:
  // Fails if the folder cannot be written, or other users can write to it.
  static base::Result<std::unique_ptr<InstanceRecord>> Write(const std::string& broker);
  ~InstanceRecord();
  InstanceRecord(const InstanceRecord&) = delete;
  InstanceRecord& operator=(const InstanceRecord&) = delete;

 private:
  explicit InstanceRecord(std::filesystem::path file) : file_(std::move(file)) {}

  const std::filesystem::path file_;
};

// The newest first. Ignores and removes the files of processes that have ended.
std::vector<Instance> RunningInstances();

}  // namespace gsv::app
