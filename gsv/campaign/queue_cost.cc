#include "gsv/campaign/queue_cost.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

namespace gsv::campaign {

std::optional<QueueCost> CostOf(const std::vector<Attempt>& attempts) {
  QueueCost cost;
  std::set<std::string> nodes;
  // time from the submission of each share to its first start, s
  std::map<std::string, double> waits;
  std::multimap<double, int> changes;  // changes of the number of used slots, by time
  double submitted = 0, first = 0, last = 0;
  for (const Attempt& attempt : attempts) {
    if (attempt.job.empty()) continue;
    const double wait = attempt.started - attempt.submitted;
    const auto [entry, is_first] = waits.try_emplace(attempt.share, wait);
    entry->second = std::min(entry->second, wait);
    const bool any = cost.tasks++ > 0;
    cost.requeued += !is_first;
    nodes.insert(attempt.node);
    cost.run_seconds += attempt.run_seconds;
    cost.task_seconds += attempt.at_once * (attempt.ended - attempt.started);
    submitted = any ? std::min(submitted, attempt.submitted) : attempt.submitted;
    first = any ? std::min(first, attempt.started) : attempt.started;
    last = std::max(last, attempt.ended);
    changes.emplace(attempt.started, attempt.at_once);
    changes.emplace(attempt.ended, -attempt.at_once);
  }
  if (cost.tasks == 0) return std::nullopt;
  // If several changes have the same time, ends of tasks come first, so that their slots count as
  // free.
  int in_use = 0, most = 0;
  for (auto change = changes.begin(); change != changes.end();) {
    const auto [begin, end] = changes.equal_range(change->first);
    for (auto each = begin; each != end; ++each) in_use += std::min(each->second, 0);
    for (auto each = begin; each != end; ++each) in_use += std::max(each->second, 0);
    most = std::max(most, in_use);
    change = end;
  }
  cost.nodes = nodes.size();
  cost.slots = static_cast<std::size_t>(most);
  for (const auto& [share, wait] : waits) {
    cost.mean_wait += wait / static_cast<double>(waits.size());
    cost.max_wait = std::max(cost.max_wait, wait);
  }
  cost.idle_seconds = std::max(0.0, most * (last - first) - cost.task_seconds);
  cost.span = last - submitted;
  return cost;
}

std::string Sentence(const QueueCost& cost) {
  const auto tasks = static_cast<double>(cost.tasks);
  return fmt::format(
      "queue: {} tasks ({} requeued) on {} nodes, at most {} runs at once; waiting time {:.1f} s "
      "(longest {:.1f} s); runs took {:.1f} s in total, and each task {:.2f} s more; slots were "
      "idle for {:.2f} s per task; {:.1f} s from first submission to last "
      "end",
      cost.tasks, cost.requeued, cost.nodes, cost.slots, cost.mean_wait, cost.max_wait,
      cost.run_seconds, (cost.task_seconds - cost.run_seconds) / tasks, cost.idle_seconds / tasks,
      cost.span);
}

nlohmann::ordered_json ToJson(const QueueCost& cost) {
  return {{"tasks", cost.tasks},           {"requeued", cost.requeued},
          {"nodes", cost.nodes},           {"slots", cost.slots},
          {"mean_wait_s", cost.mean_wait}, {"longest_wait_s", cost.max_wait},
          {"runs_s", cost.run_seconds},    {"tasks_s", cost.task_seconds},
          {"idle_s", cost.idle_seconds},   {"span_s", cost.span}};
}

}  // namespace gsv::campaign
