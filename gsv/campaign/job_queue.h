// A job queue: it accepts batches of tasks and executes them on other machines, each task as `gsv
// campaign task` (TaskCommand). The results of tasks are in the spool (spool.h), so a queue reports
// only which tasks are waiting or running.
//
// Threads  one at a time.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/campaign/spool.h"

namespace gsv::campaign {

struct QueuedTask {
  std::string state;   // "PENDING" while it waits; else "RUNNING" or another state of the queue
  std::string reason;  // why it waits: "Resources", …
};

class JobQueue {
 public:
  virtual ~JobQueue() = default;

  // The maximum number of tasks of a batch, at least 1.
  virtual base::Result<std::size_t> MaxTasks() = 0;
  // Returns the job's name in the queue. kNotRunning when the queue refuses the batch; nothing is
  // queued then. The batch's file must be in the spool before.
  virtual base::Result<std::string> Submit(const Spool& spool, const Batch& batch) = 0;
  // The tasks of these batches that wait or run, by ShareOf(). kNotFound when the queue will never
  // run a task again; any other error may be temporary.
  virtual base::Result<std::map<std::string, QueuedTask>> TasksOf(
      const std::vector<Batch>& batches) = 0;
};

// The shell command that executes one task. The texts are inserted unquoted, so that a queue may
// pass shell variables.
struct TaskCommand {
  std::string program;  // the path of gsv on the machine
  std::string batch_file;
  std::string task, job, node;  // the task's number; fields of the attempt's journal
  std::string jobs = "1";       // runs at once
  std::string more;             // options

  std::string Text() const;
};

// The line that a task prints when its journal exists, before its first run.
inline constexpr std::string_view kTaskBegins = "gsv campaign task: begins ";

}  // namespace gsv::campaign
