// Runs of scenarios, each in a process that is forked from one that has read the files.
//
// Each run costs only its simulation: the program is linked, and worlds and models are read, once
// for all runs. Files are not read again while this object lives.
//
// Threads  one at a time. The thread that makes it must live as long (machine/child_process.h).
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
  // Begins `gsv run` with these arguments; stdout and stderr go to files. One run at a time.
  base::Status Start(const std::vector<std::string>& arguments, const std::filesystem::path& output,
                     const std::filesystem::path& errors);
  // The end of the run ("exit code 5", "signal 11"), or empty at the time limit. If the process
  // that serves runs ends, that is the end of the run as well.
  std::string AwaitEnd(std::chrono::milliseconds timeout);
  // Ends the current run, if there is one.
  void Stop() { server_.reset(); }

 private:
  std::unique_ptr<ChildProcess> server_;  // null: not started
};

}  // namespace gsv::app
