// What a queue costs beyond the runs themselves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gsv/campaign/results.h"

namespace gsv::campaign {

// Machines' clocks are compared, so that seconds here are as good as these agree.
struct QueueCost {
  std::size_t tasks = 0;     // that started; one that was requeued counts again
  std::size_t requeued = 0;  // of these
  std::size_t nodes = 0;
  std::size_t slots = 0;                   // runs at once, at most
  double mean_wait = 0, longest_wait = 0;  // s, from submission to a share's first start
  double run_seconds = 0;                  // of the runs, added up
  double task_seconds = 0;                 // of the tasks' slots, added up
  double idle_seconds = 0;                 // slots · (last end − first start) − task_seconds
  double span = 0;                         // s, from the first submission to the last end
};

// Of the attempts that a queue started; nothing when there is none.
std::optional<QueueCost> CostOf(const std::vector<Attempt>& attempts);

std::string Sentence(const QueueCost& cost);
nlohmann::ordered_json ToJson(const QueueCost& cost);

}  // namespace gsv::campaign
