// Computes the time that a job queue costs in addition to the runs themselves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gsv/campaign/results.h"

namespace gsv::campaign {

// The additional time. Durations are differences between the clocks of several machines, so an
// offset between these clocks is part of them.
struct QueueCost {
  std::size_t tasks = 0;     // number of started tasks; a task that was requeued counts again
  std::size_t requeued = 0;  // number of starts that followed a requeue
  std::size_t nodes = 0;     // number of machines that executed tasks
  std::size_t slots = 0;     // maximum number of concurrent runs
  double mean_wait = 0, max_wait = 0;  // from submission to the first start of a share, s
  double run_seconds = 0;              // sum of the durations of all runs, s
  double task_seconds = 0;             // sum over the tasks of slots times duration, s
  double idle_seconds = 0;             // slots · (last end − first start) − task_seconds
  double span = 0;                     // from the first submission to the last end, s
};

// Returns the cost of the attempts that a queue started, or nullopt if there are none.
std::optional<QueueCost> CostOf(const std::vector<Attempt>& attempts);

// Returns the cost as a text for users.
std::string Sentence(const QueueCost& cost);
nlohmann::ordered_json ToJson(const QueueCost& cost);

}  // namespace gsv::campaign
