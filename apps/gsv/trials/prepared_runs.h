// Executes runs of scenarios, each in its own process. The process is forked from a run server
// (running/run_server.h).
//
// The run server loads the program's libraries, worlds and models once for all runs. So a run takes
// only the time of its simulation. Later changes of files have no effect on runs of this object.
//
// Threads  one at a time. The thread that creates this object must live as long as the object
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
  // Starts `gsv run` with these arguments. The run writes its stdout and stderr to these files.
  // Only one run at a time is allowed.
  base::Status Start(const std::vector<std::string>& arguments, const std::filesystem::path& output,
                     const std::filesystem::path& errors);
  // Returns how the run ended ("exit code 5", "signal 11"), or an empty text at the time limit. If
  // the run server ends, the run counts as ended.
  std::string AwaitEnd(std::chrono::milliseconds timeout);
  // Ends the current run, if there is one.
  void Stop() { server_.reset(); }

 private:
  std::unique_ptr<ChildProcess> server_;  // null until it is started
};

}  // namespace gsv::app
