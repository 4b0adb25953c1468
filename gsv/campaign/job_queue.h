// A job queue. It accepts batches of tasks and executes them on other machines, each task as `gsv
// campaign task` (TaskCommand). The results of tasks are in the spool (spool.h), so a queue only
// reports which tasks are waiting or running.
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
  std::string state;   // "PENDING" while it waits, else "RUNNING" or another state of the queue
  std::string reason;  // the reason why it waits, such as "Resources"
};

class JobQueue {
 public:
  virtual ~JobQueue() = default;

  // The maximum number of tasks of a batch, at least 1.
  virtual base::Result<std::size_t> MaxTasks() = 0;
  // Submits a batch, whose file must already be in the spool. Returns the job's name in the queue.
  // Returns kNotRunning if the queue refuses the batch; nothing is queued then.
  virtual base::Result<std::string> Submit(const Spool& spool, const Batch& batch) = 0;
  // Returns the tasks of these batches that wait or run, by ShareOf(). Returns kNotFound if the
  // queue will never run a task again. Any other error may be temporary.
  virtual base::Result<std::map<std::string, QueuedTask>> TasksOf(
      const std::vector<Batch>& batches) = 0;
};

// The shell command that executes one task. The texts are inserted unquoted, so that a queue may
// pass shell variables.
struct TaskCommand {
  std::string program;  // the path of gsv on the machine
  std::string batch_file;
  std::string task, job, node;  // the number of the task, and the fields of its attempt's journal
  std::string jobs = "1";       // how many runs are executed at once
  std::string more;             // further options

  std::string Text() const;
};

// A task prints this text with its journal when the journal exists, before its first run.
inline constexpr std::string_view kTaskBegins = "gsv campaign task: begins ";

}  // namespace gsv::campaign
