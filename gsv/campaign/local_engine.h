// Executes a campaign's runs on this machine, a limited number at a time.
#pragma once

#include <atomic>
#include <functional>

#include "gsv/campaign/results.h"

namespace gsv::campaign {

// The progress of a campaign.
struct Progress {
  // Numbers of runs: of the whole campaign, with a result, and with a result that is not "passed".
  // `done` includes the runs that earlier processes have executed for this campaign.
  std::size_t planned = 0, done = 0, not_passed = 0;
  // estimated wall-clock time to the end; 0 if unknown
  double seconds_left = 0;
};

struct LocalEngine {
  int jobs = 1;  // maximum number of runs at the same time
  // Executes one run. The engine calls it on one of its threads. nullopt means that the run was
  // cancelled and does not count.
  std::function<std::optional<RunResult>(std::int64_t run, const std::atomic<bool>& is_cancelled)>
      execute;
  std::function<void(const Progress&)> report;  // called about twice a second
  std::function<bool()> is_interrupted;         // whether the user has interrupted the campaign

  // Blocks until the results contain all runs, or until the user interrupts it. An interrupt
  // cancels the runs in progress and keeps the results. Fails if the results cannot be written.
  base::Status Run(Results& results) const;
  // Executes these runs. Calls `keep` with the results that are new since the previous call, so
  // each result is passed once. `progress` is the progress of the campaign before these runs.
  base::Status Execute(
      std::vector<std::int64_t> runs, Progress progress,
      const std::function<base::Status(const std::vector<RunResult>&)>& keep) const;
};

}  // namespace gsv::campaign
