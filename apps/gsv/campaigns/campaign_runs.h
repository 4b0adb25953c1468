// Executes the runs of a campaign. Each run is in its own child process on this machine, or on a
// server.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>

#include "apps/gsv/servers/scenario_servers.h"
#include "apps/gsv/trials/test_cases.h"
#include "gsv/campaign/results.h"

namespace gsv::app {

// Executes single runs. Any number of threads may call Execute() at once.
class RunExecutor {
 public:
  // `folder` is for temporary files. `failures` is a folder for the recordings of failed runs, or
  // empty if they are not recorded. `timeout` is the limit of wall-clock time per run, in s.
  // `servers` execute the runs and must outlive this object. If `servers` is null, this machine
  // executes the runs.
  RunExecutor(const campaign::Campaign& campaign, std::filesystem::path folder,
              std::filesystem::path failures, double timeout, ScenarioServers* servers = nullptr);

  // Executes a run. Returns nullopt if the run was cancelled.
  std::optional<campaign::RunResult> Execute(std::int64_t run,
                                             const std::atomic<bool>& is_cancelled) const;

 private:
  // Executes a run in a child process on this machine.
  TestResult RunHere(std::int64_t run, const std::string& scenario,
                     const std::atomic<bool>& is_cancelled) const;

  const campaign::Campaign& campaign_;
  const std::filesystem::path folder_;
  ScenarioServers* const servers_;  // null if this machine executes the runs
  TestOptions options_;             // the options of each run
};

}  // namespace gsv::app
