// The interface to a job queue, such as Slurm. The queue accepts batches of tasks and executes them
// on other machines, each task as `gsv campaign task` (TaskCommand). The results of tasks are in
// the spool (spool.h), so a queue only reports which tasks are waiting or running.
//
// Threads  one at a time.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/campaign/spool.h"

namespace gsv::campaign {

// A task that is waiting or running in the queue.
struct QueuedTask {
  std::string state;   // "PENDING" for a waiting task, else "RUNNING" or another state of the queue
  std::string reason;  // the reason why the task waits, such as "Resources"
};

class JobQueue {
 public:
  virtual ~JobQueue() = default;

  // Returns the maximum number of tasks in a batch, at least 1.
  virtual base::Result<std::size_t> MaxTasks() = 0;
  // Submits a batch, whose file must already be in the spool. Returns the job's name in the queue.
  // Returns kNotRunning if the queue refuses the batch; nothing is queued then.
  virtual base::Result<std::string> Submit(const Spool& spool, const Batch& batch) = 0;
  // Returns the waiting and running tasks of these batches. The keys of the map are the names that
  // Batch::ShareOf() returns. Returns kNotFound if the queue will never run a task again. Any other
  // error may be temporary.
  virtual base::Result<std::map<std::string, QueuedTask>> TasksOf(
      const std::vector<Batch>& batches) = 0;
};

// The shell command that executes one task. All texts except the two paths are inserted unquoted,
// so that a queue may pass shell variables.
struct TaskCommand {
  std::string program;     // the path of gsv on the machine
  std::string batch_file;  // path of the batch's file in the spool
  // the number of the task, and the fields `job` and `node` of its journal
  std::string task, job, node;
  std::string jobs = "1";  // how many runs are executed at once
  std::string more;        // more options of `gsv campaign task`

  // Returns the command as a line for a shell.
  std::string Text() const;
};

// A task prints this text and the name of its share on stderr when its journal exists, before its
// first run. A queue that reads the task's output thereby knows that the task has begun.
inline constexpr std::string_view kTaskBegins = "gsv campaign task: begins ";

}  // namespace gsv::campaign
