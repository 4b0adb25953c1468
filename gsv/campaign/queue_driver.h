// Has a campaign's runs done by a job queue: hands them out as batches of tasks, gathers what
// comes, and hands out again what was lost.
//
// A run counts once whatever ends when: tasks only append to journals of their own (spool.h), the
// results take a run's first result. The driver holds no state but what lies in spool and queue, so
// that any other goes on where it stopped. What the queue still holds is not handed out again: a
// batch is written down, under a name of its own, before it is submitted.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "gsv/campaign/job_queue.h"
#include "gsv/campaign/local_engine.h"

namespace gsv::campaign {

struct QueueDriver {
  JobQueue& queue;
  std::string title;  // the queue's, in sentences
  std::size_t runs_per_task =
      0;                 // 0: so many that 1,000 tasks take all, or fewer for a small queue
  double timeout = 300;  // wall seconds a run may take
  std::string failures;  // a folder for what failed runs leave, as the nodes see it; or empty
  bool waits = true;     // else it only hands out
  std::chrono::milliseconds poll_period{10'000};  // between questions to the queue
  std::function<void(const Progress&)> tell;
  std::function<void(const std::string& sentence)> say;  // to whoever started it
  // Waits so long; true as soon as somebody wants it to stop.
  std::function<bool(std::chrono::milliseconds)> is_interrupted;

  // Until all runs are in the results, or it is interrupted: then the queue goes on by itself.
  base::Status Run(Spool& spool, Results& results) const;
};

}  // namespace gsv::campaign
