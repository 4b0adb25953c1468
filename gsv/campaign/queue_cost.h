// The overhead of a job queue beyond the runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gsv/campaign/results.h"

namespace gsv::campaign {

// The durations compare clocks of several machines and are as accurate as those agree.
struct QueueCost {
  std::size_t tasks = 0;     // started tasks; a requeued one counts again
  std::size_t requeued = 0;  // requeued tasks among them
  std::size_t nodes = 0;
  std::size_t slots = 0;               // maximum of concurrent runs
  double mean_wait = 0, max_wait = 0;  // s, from submission to a share's first start
  double run_seconds = 0;              // sum over the runs
  double task_seconds = 0;             // sum over the tasks' slots
  double idle_seconds = 0;             // slots · (last end − first start) − task_seconds
  double span = 0;                     // s, from the first submission to the last end
};

// The cost of the attempts that a queue started; nothing if there are none.
std::optional<QueueCost> CostOf(const std::vector<Attempt>& attempts);

std::string Sentence(const QueueCost& cost);
nlohmann::ordered_json ToJson(const QueueCost& cost);

}  // namespace gsv::campaign
