// Executes a campaign's runs by a job queue: it submits batches of tasks, collects the results and
// resubmits lost runs.
//
// A run counts once: tasks append only to their own journals (spool.h), and the results keep the
// first result of a run. All state is in the spool and the queue, so that another driver can
// continue. Runs that the queue still holds are not submitted again: a batch is recorded under a
// unique name before it is submitted.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "gsv/campaign/job_queue.h"
#include "gsv/campaign/local_engine.h"

namespace gsv::campaign {

struct QueueDriver {
  JobQueue& queue;
  std::string title;  // the name of the queue in messages
  // 0: chosen so that there are at most 1,000 tasks, or fewer for a small queue.
  std::size_t runs_per_task = 0;
  double timeout = 300;  // time limit of a run, s of wall-clock time
  std::string failures;  // a folder for the files of failed runs, as the nodes name it; or empty
  bool waits = true;     // false: it only submits
  std::chrono::milliseconds poll_period{10'000};  // between queries of the queue
  std::function<void(const Progress&)> report;
  std::function<void(const std::string& sentence)> say;  // prints for the user
  // Waits that long; returns true at once when the user interrupts.
  std::function<bool(std::chrono::milliseconds)> is_interrupted;

  // Blocks until all runs are in the results or it is interrupted. After an interrupt the queue
  // continues.
  base::Status Run(Spool& spool, Results& results) const;
};

}  // namespace gsv::campaign
