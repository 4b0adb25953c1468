// Executes a campaign's runs through a job queue. It submits batches of tasks, collects the results
// and resubmits lost runs.
//
// Each run counts once: tasks append only to their own journals (spool.h), and the results keep the
// first result of a run. All state is in the spool and the queue. So if the driver, this process,
// ends, a driver that the user starts later can continue. It does not submit runs that are still in
// the queue, because a batch is recorded under a unique name before it is submitted.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "gsv/campaign/job_queue.h"
#include "gsv/campaign/local_engine.h"

namespace gsv::campaign {

struct QueueDriver {
  JobQueue& queue;    // the queue to which the driver submits batches
  std::string title;  // the name of the queue in messages
  // Number of runs per task. If it is 0, the driver chooses it. It divides the runs among at most
  // 1,000 tasks, and at most JobQueue::MaxTasks() tasks.
  std::size_t runs_per_task = 0;
  double timeout = 300;  // wall-clock time limit of a run, s
  // folder for the files of failed runs, as a path on the nodes; may be empty
  std::string failures;
  bool waits = true;                              // if false, Run() returns after submitting
  std::chrono::milliseconds poll_period{10'000};  // time between queries of the queue
  std::function<void(const Progress&)> report;
  std::function<void(const std::string& sentence)> say;  // prints a sentence for the user
  // Waits for the given time. Returns true at once if the user interrupts.
  std::function<bool(std::chrono::milliseconds)> is_interrupted;

  // Submits the runs. Then, if `waits` is true, blocks until the results contain all runs, or until
  // the user interrupts it. After an interrupt, the tasks continue if the engine outlives the
  // driver (EngineType::outlives_driver).
  base::Status Run(Spool& spool, Results& results) const;
};

}  // namespace gsv::campaign
