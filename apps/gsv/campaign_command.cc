#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/gsv/commands.h"
#include "apps/gsv/exit_code.h"
#include "apps/gsv/servers/scenario_servers.h"
#include "apps/gsv/test_cases.h"
#include "gsv/base/temporary_folder.h"
#include "gsv/campaign/local_engine.h"
#include "gsv/campaign/report.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;
using campaign::Campaign;
using campaign::RunResult;

struct CampaignArguments {
  std::string file, results, failures, csv, svg, html, broker, servers;
  std::vector<std::string> by, metrics;
  int jobs = 0;
  double timeout = 300;
  std::int64_t run = 0;
  bool json = false;
};

constexpr int kRunsWithServers = 64;  // at once, waiting for room included

// FILE.yaml has its results in FILE.sqlite.
std::string ResultsFile(const CampaignArguments& arguments) {
  if (!arguments.results.empty()) return arguments.results;
  const fs::path file = arguments.file;
  return file.extension() == ".sqlite" ? file : fs::path(file).replace_extension(".sqlite");
}

// kOk, or what to exit with after having told why.
int ReadCampaignFile(const std::string& file, Campaign& campaign) {
  base::Problems problems;
  auto read = campaign::ReadCampaign(file, problems);
  for (const base::Problem& problem : problems) {
    std::fprintf(stderr, "gsv: error: %s\n", problem.Sentence().c_str());
  }
  if (!read) return Complain(read.error());
  campaign = *std::move(read);
  return problems.empty() ? kOk : kBadModel;
}

// The numbers of a run's report, by name.
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

class RunTaker {
 public:
  // `servers`: that do the runs; null: this machine does.
  RunTaker(const Campaign& campaign, const CampaignArguments& arguments, fs::path folder,
           ScenarioServers* servers)
      : campaign_(campaign), folder_(std::move(folder)), servers_(servers) {
    options_.timeout = arguments.timeout;
    options_.failures = arguments.failures;
    options_.record = !arguments.failures.empty();
    options_.threads = 1;
  }

  std::optional<RunResult> Take(std::int64_t run, const std::atomic<bool>& is_cancelled) const {
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

 private:
  TestResult RunHere(std::int64_t run, const std::string& scenario,
                     const std::atomic<bool>& is_cancelled) const {
    const fs::path file = folder_ / fmt::format("run_{:06}.yaml", run);
    std::ofstream(file) << scenario;
    TestResult result = RunTestCase({file, file.stem().string()}, options_, is_cancelled);
    std::error_code ignored;
    fs::remove(file, ignored);
    return result;
  }

  const Campaign& campaign_;
  const fs::path folder_;
  ScenarioServers* const servers_;
  TestOptions options_;
};

void TellProgress(const campaign::Progress& progress) {
  if (isatty(STDERR_FILENO) != 1) return;
  std::fprintf(stderr, "\r\033[K%zu of %zu runs, %zu not passed%s", progress.done, progress.planned,
               progress.not_passed,
               progress.seconds_left > 0 && progress.done < progress.planned
                   ? fmt::format(", {:.0f} s left", progress.seconds_left).c_str()
                   : "");
  if (progress.done == progress.planned) std::fputs("\n", stderr);
}

// Prints how it stands; gives the exit code: 1 when a run has not passed.
int TellStatus(campaign::Results& results, bool json) {
  const auto all = results.All();
  const auto planned = results.PlannedRuns();
  if (!all || !planned) return Complain(all ? planned.error() : all.error());
  std::map<std::string, std::size_t> by_status{{"passed", 0}, {"failed", 0}, {"error", 0}};
  for (const RunResult& result : *all) ++by_status[result.status];
  if (json) {
    const nlohmann::ordered_json line{{"planned", *planned},
                                      {"done", all->size()},
                                      {"passed", by_status["passed"]},
                                      {"failed", by_status["failed"]},
                                      {"errors", by_status["error"]}};
    std::puts(line.dump().c_str());
  } else {
    std::printf("%zu of %lld runs: %zu passed, %zu failed, %zu error%s\n", all->size(),
                static_cast<long long>(*planned), by_status["passed"], by_status["failed"],
                by_status["error"], by_status["error"] == 1 ? "" : "s");
  }
  return by_status["passed"] == all->size() ? kOk : kAssertionFailed;
}

int RunCampaign(const CampaignArguments& arguments, Signals& signals) {
  Campaign campaign;
  if (const int code = ReadCampaignFile(arguments.file, campaign); code != kOk) return code;
  auto results = campaign::Results::OpenToAdd(ResultsFile(arguments), campaign);
  if (!results) return Complain(results.error());
  const auto folder = base::TemporaryFolder::Make("gsv-campaign");
  if (!folder) return Complain(folder.error());
  std::unique_ptr<ScenarioServers> servers;
  if (!arguments.broker.empty()) {
    auto found = ScenarioServers::Find(arguments.broker, arguments.servers);
    if (!found) return Complain(found.error());
    servers = *std::move(found);
  }
  const RunTaker taker(campaign, arguments, folder->path(), servers.get());
  bool is_interrupted = false;
  campaign::LocalEngine engine;
  engine.jobs = arguments.jobs > 0 ? arguments.jobs
                : servers != nullptr
                    ? kRunsWithServers
                    : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  engine.take = [&](std::int64_t run, const std::atomic<bool>& is_cancelled) {
    return taker.Take(run, is_cancelled);
  };
  engine.tell = &TellProgress;
  engine.is_interrupted = [&] {
    is_interrupted = is_interrupted || signals.WaitFor(0) != 0;
    return is_interrupted || (servers != nullptr && !servers->failure().empty());
  };
  if (auto ok = engine.Run(**results); !ok) return Complain(ok.error());
  const int code = TellStatus(**results, arguments.json);
  if (servers != nullptr && !servers->failure().empty() && !is_interrupted) {
    return Complain({base::ErrorCode::kUnavailable, servers->failure()});
  }
  if (!is_interrupted) return code;
  std::fprintf(stderr, "gsv: interrupted; the same command goes on where this stopped\n");
  return kInterrupted;
}

int WriteReportFile(const std::string& file, const std::string& text) {
  if (file.empty()) return kOk;
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (stream.flush()) return kOk;
  return Complain({base::ErrorCode::kUnavailable, "the report cannot be written", file});
}

int ReportCampaign(const CampaignArguments& arguments) {
  auto results = campaign::Results::Open(ResultsFile(arguments));
  if (!results) return Complain(results.error());
  const auto all = (*results)->All();
  const auto parameters = (*results)->Parameters();
  const auto planned = (*results)->PlannedRuns();
  if (!all || !parameters || !planned) {
    return Complain(!all ? all.error() : !parameters ? parameters.error() : planned.error());
  }
  for (const std::string& parameter : arguments.by) {
    if (std::find(parameters->begin(), parameters->end(), parameter) != parameters->end()) continue;
    return Complain({base::ErrorCode::kInvalidArgument, "the campaign varies no such parameter",
                     "--by " + parameter});
  }
  campaign::Report report =
      campaign::MakeReport(*all, arguments.by, *parameters, arguments.metrics);
  report.title = fs::path(arguments.file).stem();
  report.planned = *planned;
  std::fputs(campaign::ToText(report).c_str(), stdout);
  for (const auto& [file, text] : {std::pair(arguments.csv, campaign::ToCsv(*all, *parameters)),
                                   std::pair(arguments.svg, campaign::ToSvg(report)),
                                   std::pair(arguments.html, campaign::ToHtml(report))}) {
    if (const int code = WriteReportFile(file, text); code != kOk) return code;
  }
  return kOk;
}

int ShowRun(const CampaignArguments& arguments) {
  Campaign campaign;
  if (const int code = ReadCampaignFile(arguments.file, campaign); code != kOk) return code;
  if (arguments.run < 0 || arguments.run >= static_cast<std::int64_t>(campaign.runs())) {
    return Complain({base::ErrorCode::kInvalidArgument,
                     fmt::format("its runs are 0 to {}", campaign.runs() - 1), arguments.file});
  }
  const auto scenario =
      campaign.ScenarioWith(campaign.ValuesOf(static_cast<std::size_t>(arguments.run)));
  if (!scenario) return Complain(scenario.error());
  std::fputs(scenario->c_str(), stdout);
  return kOk;
}

}  // namespace

void AddCampaignCommand(const CommandLine& line) {
  CLI::App* command =
      line.app.add_subcommand("campaign", "Run a scenario many times, with parameters varied");
  command->require_subcommand(1);
  auto arguments = std::make_shared<CampaignArguments>();
  const auto add = [&](const char* name, const char* what) {
    CLI::App* sub = command->add_subcommand(name, what);
    sub->add_option("file", arguments->file, "the campaign's file, NAME.yaml")->required();
    return sub;
  };
  CLI::App* run = add("run", "Do all runs that are not done yet; exit code 1 if one did not pass");
  run->add_option("-j,--jobs", arguments->jobs,
                  "how many at once; 0: one a processor, or as many as the servers take")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  run->add_option("--timeout", arguments->timeout, "wall seconds a run may take")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  run->add_option("--failures", arguments->failures,
                  "a folder in which each failure leaves its recording and a picture; without it "
                  "nothing is recorded");
  CLI::Option* broker =
      run->add_option("--broker", arguments->broker,
                      "do them on the servers that this broker knows (gsv serve --scenarios N), "
                      "corbaloc::1.2@HOST:PORT/TradingService; without it: here")
          ->excludes("--failures");
  run->add_option("--servers", arguments->servers,
                  "with --broker: which servers, as a constraint over docs/services.md's "
                  "properties; without it: all")
      ->needs(broker);
  run->callback([=] { line.exit_code = RunCampaign(*arguments, line.signals); });
  CLI::App* status = add("status", "How many runs are done, and how many passed");
  status->callback([=] {
    auto results = campaign::Results::Open(ResultsFile(*arguments));
    line.exit_code = results ? TellStatus(**results, arguments->json) : Complain(results.error());
  });
  CLI::App* report = add("report", "What the results say, by parameters");
  report->add_option("--by", arguments->by, "parameters to look at, separated by commas")
      ->delimiter(',');
  report->add_option("--metric", arguments->metrics, "a metric to show the mean of");
  report->add_option("--csv", arguments->csv, "a file for all runs, one a line");
  report->add_option("--svg", arguments->svg, "a file for the plot");
  report->add_option("--html", arguments->html, "a file for a page with plot and table");
  report->callback([=] { line.exit_code = ReportCampaign(*arguments); });
  CLI::App* show = add("show", "Print one run's scenario, for `gsv run`");
  show->add_option("run", arguments->run, "its number, from 0")->required();
  show->callback([=] { line.exit_code = ShowRun(*arguments); });
  for (CLI::App* sub : {run, status, report}) {
    sub->add_option("--results", arguments->results,
                    "the results' file (NAME.sqlite beside the campaign's)");
  }
  for (CLI::App* sub : {run, status}) sub->add_flag("--json", arguments->json, "one JSON object");
}

}  // namespace gsv::app
