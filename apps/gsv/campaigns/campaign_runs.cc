#include "apps/gsv/campaigns/campaign_runs.h"

#include <fstream>

#include <fmt/format.h>

namespace gsv::app {

namespace fs = std::filesystem;
using campaign::RunResult;

namespace {

// Returns the metrics of a run: the numbers in its report, by name.
nlohmann::ordered_json MetricsOf(const nlohmann::ordered_json& report) {
  auto metrics = nlohmann::ordered_json::object();
  const auto list = [&](const char* name) {
    return report.value(name, nlohmann::ordered_json::array());
  };
  for (const auto& robot : list("robots")) {
    const std::string name = robot.value("name", "");
    for (const char* number : {"distance_m", "collisions"}) {
      if (robot.contains(number)) metrics[name + "." + number] = robot[number];
    }
  }
  for (const auto& expectation : list("expectations")) {
    const std::string name = expectation.value("name", "");
    metrics[name + ": time_s"] = expectation.value("time_s", 0.0);
    for (const auto& measured : expectation["measured"]) {
      if (!measured.contains("lowest")) continue;
      metrics["lowest of " + measured.value("what", "")] = measured["lowest"];
      metrics["highest of " + measured.value("what", "")] = measured["highest"];
    }
  }
  return metrics;
}

}  // namespace

RunExecutor::RunExecutor(const campaign::Campaign& campaign, fs::path folder, fs::path failures,
                         double timeout, ScenarioServers* servers)
    : campaign_(campaign), folder_(std::move(folder)), servers_(servers) {
  options_.timeout = timeout;
  options_.record = !failures.empty();
  options_.failures = std::move(failures);
  options_.threads = 1;
}

std::optional<RunResult> RunExecutor::Execute(std::int64_t run,
                                              const std::atomic<bool>& is_cancelled) const {
  const auto values = campaign_.ValuesOf(static_cast<std::size_t>(run));
  RunResult result{run, "error"};
  for (std::size_t i = 0; i < values.size(); ++i) {
    result.parameters[campaign_.parameters[i].path] = values[i];
  }
  const auto scenario = campaign_.ScenarioWith(values);
  if (!scenario) {
    result.message = scenario.error().Sentence();
    return result;
  }
  const TestResult test = servers_ != nullptr
                              ? servers_->Run(*scenario, options_.timeout, is_cancelled)
                              : RunHere(run, *scenario, is_cancelled);
  if (test.status == TestResult::Status::kInterrupted) return std::nullopt;
  if (test.status == TestResult::Status::kPassed) result.status = "passed";
  if (test.status == TestResult::Status::kFailed) result.status = "failed";
  result.message = test.message;
  if (!test.hashes.empty()) result.state_hash = test.hashes.back();
  result.sim_time = test.report.value("sim_time_s", 0.0);
  result.wall_time = test.wall_seconds;
  const fs::path recording = fs::path(test.folder) / "run.mcap";
  std::error_code ignored;
  if (!test.folder.empty() && fs::exists(recording, ignored)) result.recording = recording;
  result.metrics = MetricsOf(test.report);
  return result;
}

TestResult RunExecutor::RunHere(std::int64_t run, const std::string& scenario,
                                const std::atomic<bool>& is_cancelled) const {
  const fs::path file = folder_ / fmt::format("run_{:06}.yaml", run);
  TestResult result;
  if (std::ofstream out(file); out << scenario << std::flush) {
    const std::string name = file.stem().string();
    result = RunTestCase({file, name, name, true}, options_, is_cancelled);
  } else {
    result.message = "cannot write the scenario to " + file.string();
  }
  std::error_code ignored;
  fs::remove(file, ignored);
  return result;
}

}  // namespace gsv::app
