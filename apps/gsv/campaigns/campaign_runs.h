// Executes the runs of a campaign, each in its own child process, here or on a server.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>

#include "apps/gsv/servers/scenario_servers.h"
#include "apps/gsv/trials/test_cases.h"
#include "gsv/campaign/results.h"

namespace gsv::app {

// Threads  Take() from any number at once, on threads that live until it returns.
class RunTaker {
 public:
  // `folder`: for temporary files. `failures`: folder for the recordings of failed runs; empty:
  // they are not recorded. `timeout`: s of wall-clock time per run. `servers`: execute the runs,
  // and must outlive this; null: this machine executes them.
  RunTaker(const campaign::Campaign& campaign, std::filesystem::path folder,
           std::filesystem::path failures, double timeout, ScenarioServers* servers = nullptr);

  // Nothing if the run was cancelled.
  std::optional<campaign::RunResult> Take(std::int64_t run,
                                          const std::atomic<bool>& is_cancelled) const;

 private:
  TestResult RunHere(std::int64_t run, const std::string& scenario,
                     const std::atomic<bool>& is_cancelled) const;

  const campaign::Campaign& campaign_;
  const std::filesystem::path folder_;
  ScenarioServers* const servers_;
  TestOptions options_;
};

}  // namespace gsv::app
