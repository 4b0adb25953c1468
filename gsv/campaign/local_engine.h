// Runs a campaign's runs on this machine, so many at a time.
#pragma once

#include <atomic>
#include <functional>

#include "gsv/campaign/results.h"

namespace gsv::campaign {

struct Progress {
  std::size_t planned = 0, done = 0, not_passed = 0;  // done: those of earlier drivers included
  double seconds_left = 0;                            // wall time; 0: not known yet
};

struct LocalEngine {
  int jobs = 1;
  // Takes one run, on a thread of the engine's that lives as long as that; nothing when it was
  // cancelled, and then it does not count.
  std::function<std::optional<RunResult>(std::int64_t run, const std::atomic<bool>& is_cancelled)>
      take;
  std::function<void(const Progress&)> tell;  // about twice a second
  std::function<bool()> is_interrupted;

  // Until all are in the results, or it is interrupted: then what is under way is given up, and
  // what is done is kept. Fails when the results cannot be written.
  base::Status Run(Results& results) const;
  // The same of these runs, each given to `keep` once. `progress`: as it stands before.
  base::Status Take(std::vector<std::int64_t> runs, Progress progress,
                    const std::function<base::Status(const std::vector<RunResult>&)>& keep) const;
};

}  // namespace gsv::campaign
