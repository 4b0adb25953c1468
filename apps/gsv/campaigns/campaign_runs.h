// The runs of a campaign, each taken in a child process of its own, here or by a server.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>

#include "apps/gsv/servers/scenario_servers.h"
#include "apps/gsv/trials/test_cases.h"
#include "gsv/campaign/results.h"

namespace gsv::app {

// Threads  Take() any number at once, on threads that live until it returns.
class RunTaker {
 public:
  // `folder`: for what it needs in between. `failures`: where failed runs leave their recordings;
  // empty: nothing is recorded. `timeout`: wall seconds a run. `servers`: that do the runs, and
  // outlive this; null: this machine does.
  RunTaker(const campaign::Campaign& campaign, std::filesystem::path folder,
           std::filesystem::path failures, double timeout, ScenarioServers* servers = nullptr);

  // Nothing when it was cancelled.
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
