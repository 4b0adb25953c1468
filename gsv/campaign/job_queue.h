// A job queue: takes batches of tasks and has them run on other machines, each task as
// `gsv campaign task` (TaskCommand). What the tasks have done lies in the spool (spool.h), so that
// a queue reports only which tasks it still holds.
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
  std::string state;   // "PENDING" while it waits; else "RUNNING" or a word of the queue's own
  std::string reason;  // why it waits: "Resources", …
};

class JobQueue {
 public:
  virtual ~JobQueue() = default;

  // How many tasks one batch may have; at least 1.
  virtual base::Result<std::size_t> MaxTasks() = 0;
  // Returns the job's name in the queue. kNotRunning when the queue refuses the batch: then nothing
  // was queued. The batch's file is in the spool already.
  virtual base::Result<std::string> Submit(const Spool& spool, const Batch& batch) = 0;
  // The tasks of these batches that wait or run, by ShareOf(). kNotFound when the queue will never
  // run a task again; any other error may pass.
  virtual base::Result<std::map<std::string, QueuedTask>> TasksOf(
      const std::vector<Batch>& batches) = 0;
};

// The shell command that does one task. The texts are put in as they are, so that a queue may give
// variables of its own shell.
struct TaskCommand {
  std::string program;  // gsv, as the machine finds it
  std::string batch_file;
  std::string task, job, node;  // the task's number; what the attempt's journal says
  std::string jobs = "1";       // runs at once
  std::string more;             // options

  std::string Text() const;
};

// What a task prints before its first run, once its journal is there.
inline constexpr std::string_view kTaskBegins = "gsv campaign task: begins ";

}  // namespace gsv::campaign
