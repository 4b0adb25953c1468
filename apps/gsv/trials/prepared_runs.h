// Runs of scenarios. Each is in a process that is forked from one that has read the files.
//
// A run costs only its simulation, because the program is linked, and worlds and models are read,
// once for all runs. Files are not read again while this object lives.
//
// Threads  one at a time. The thread that creates this object must live as long as it
//          (machine/child_process.h).
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/gsv/machine/child_process.h"
#include "gsv/base/error.h"

namespace gsv::app {

class PreparedRuns {
 public:
  // Starts `gsv run` with these arguments. Its stdout and stderr go to files. Only one run at a
  // time is allowed.
  base::Status Start(const std::vector<std::string>& arguments, const std::filesystem::path& output,
                     const std::filesystem::path& errors);
  // Returns how the run ended ("exit code 5", "signal 11"), or an empty text at the time limit. If
  // the process that serves runs ends, the run has ended as well.
  std::string AwaitEnd(std::chrono::milliseconds timeout);
  // Ends the current run, if there is one.
  void Stop() { server_.reset(); }

 private:
  std::unique_ptr<ChildProcess> server_;  // null until it is started
};

}  // namespace gsv::app
