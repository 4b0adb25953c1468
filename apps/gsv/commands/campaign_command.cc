#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/gsv/campaigns/campaign_engines.h"
#include "apps/gsv/commands/commands.h"
#include "apps/gsv/process/exit_code.h"
#include "gsv/campaign/queue_cost.h"
#include "gsv/campaign/report.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;
using campaign::Campaign;
using campaign::RunResult;

constexpr std::chrono::seconds kLockPatience{5};  // with a `status` that gathers

struct CampaignArguments {
  std::string file, results, csv, svg, html, shard;
  std::vector<std::string> by, metrics;
  campaign::EngineRequest engine;
  std::int64_t run = 0;
  bool json = false;
  EngineOptions options;
  TaskArguments task;
};

// FILE.yaml has its results in FILE.sqlite.
std::string ResultsFile(const CampaignArguments& arguments) {
  if (!arguments.results.empty()) return arguments.results;
  const fs::path file = arguments.file;
  return file.extension() == ".sqlite" ? file : fs::path(file).replace_extension(".sqlite");
}

// kOk, or what to exit with after having told why.
int ReadCampaignFile(const std::string& file, Campaign& campaign,
                     const campaign::EngineRequest& request, campaign::Engine& engine) {
  base::Problems problems;
  auto read = campaign::ReadCampaign(file, problems, request, engine);
  for (const base::Problem& problem : problems) {
    std::fprintf(stderr, "gsv: error: %s\n", problem.Sentence().c_str());
  }
  if (!read) return Complain(read.error());
  campaign = *std::move(read);
  return problems.empty() ? kOk : kBadModel;
}

// Prints how it stands; gives the exit code: 1 when a run has not passed.
int TellStatus(campaign::Results& results, bool json) {
  const auto all = results.All();
  const auto planned = results.PlannedRuns();
  const auto attempts = results.Attempts();
  if (!all || !planned || !attempts)
    return Complain(!all ? all.error() : !planned ? planned.error() : attempts.error());
  const auto cost = campaign::CostOf(*attempts);
  std::map<std::string, std::size_t> by_status{{"passed", 0}, {"failed", 0}, {"error", 0}};
  for (const RunResult& result : *all) ++by_status[result.status];
  if (json) {
    nlohmann::ordered_json line{{"planned", *planned},
                                {"done", all->size()},
                                {"passed", by_status["passed"]},
                                {"failed", by_status["failed"]},
                                {"errors", by_status["error"]}};
    if (cost) line["queue"] = campaign::ToJson(*cost);
    std::puts(line.dump().c_str());
  } else {
    std::printf("%zu of %lld runs: %zu passed, %zu failed, %zu error%s\n", all->size(),
                static_cast<long long>(*planned), by_status["passed"], by_status["failed"],
                by_status["error"], by_status["error"] == 1 ? "" : "s");
    if (cost) std::printf("%s\n", campaign::Sentence(*cost).c_str());
  }
  return by_status["passed"] == all->size() ? kOk : kAssertionFailed;
}

int RunCampaign(const CampaignArguments& arguments, Signals& signals) {
  Campaign campaign;
  EngineOptions options = arguments.options;
  if (const int code = ReadCampaignFile(arguments.file, campaign, arguments.engine, options.engine);
      code != kOk) {
    return code;
  }
  const std::string file = ResultsFile(arguments);
  if (!arguments.shard.empty()) {
    const auto shard = ParseShard(arguments.shard);
    return shard ? RunShard(campaign, file, *shard, options, signals) : Complain(shard.error());
  }
  if (const int code = GatherSpool(file); code != kOk) return code;
  auto results = campaign::Results::OpenToAdd(file, campaign, kLockPatience);
  if (!results) return Complain(results.error());
  const bool is_queued = options.broker.empty() && options.engine.make_queue;
  const int code = is_queued ? RunByQueue(campaign, **results, file, options, signals)
                             : RunHere(campaign, **results, options, signals);
  if (code != kOk && code != kInterrupted) return code;
  const int verdict = TellStatus(**results, arguments.json);
  return code == kOk ? verdict : code;
}

int WriteReportFile(const std::string& file, const std::string& text) {
  if (file.empty()) return kOk;
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (stream.flush()) return kOk;
  return Complain({base::ErrorCode::kUnavailable, "the report cannot be written", file});
}

int TellStatusOf(const CampaignArguments& arguments) {
  if (const int code = GatherSpool(ResultsFile(arguments)); code != kOk) return code;
  auto results = campaign::Results::Open(ResultsFile(arguments));
  return results ? TellStatus(**results, arguments.json) : Complain(results.error());
}

int ReportCampaign(const CampaignArguments& arguments) {
  if (const int code = GatherSpool(ResultsFile(arguments)); code != kOk) return code;
  auto results = campaign::Results::Open(ResultsFile(arguments));
  if (!results) return Complain(results.error());
  const auto all = (*results)->All();
  const auto parameters = (*results)->Parameters();
  const auto planned = (*results)->PlannedRuns();
  const auto attempts = (*results)->Attempts();
  if (!all || !parameters || !planned || !attempts) {
    return Complain(!all          ? all.error()
                    : !parameters ? parameters.error()
                    : !planned    ? planned.error()
                                  : attempts.error());
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
  if (const auto cost = campaign::CostOf(*attempts)) report.queue = campaign::Sentence(*cost);
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
  campaign::Engine ignored;
  if (const int code = ReadCampaignFile(arguments.file, campaign, {}, ignored); code != kOk)
    return code;
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

using Arguments = std::shared_ptr<CampaignArguments>;

// The options of `--engine`, of job queues in general and of each engine. Returns --engine.
CLI::Option* AddEngineOptions(CLI::App* run, const Arguments& arguments) {
  EngineOptions& options = arguments->options;
  campaign::EngineRequest& engine = arguments->engine;
  std::vector<std::string> names;
  std::string help;
  for (const campaign::EngineType& type : campaign::EngineTypes()) {
    names.push_back(type.name);
    help += (help.empty() ? "" : "; ") + type.name + ": " + type.help;
    for (const campaign::EngineOption& option : type.options) {
      if (engine.options.contains(option.flag)) continue;  // two engines may share it
      CLI::Option* added = run->add_option(option.flag, engine.options[option.flag], option.help)
                               ->allow_extra_args(false)
                               ->group(type.title);
      if (!option.is_list) added->take_last();
    }
  }
  run->add_option("--runs-a-task", engine.runs_per_task,
                  "runs of a task, one after another (default: so many that 1,000 tasks take all)")
      ->check(CLI::Range(0, static_cast<int>(campaign::kMaxRuns)))
      ->group("Job queues");
  run->add_option("--poll", options.poll,
                  "seconds between questions to the queue (default: 10; ssh: 0.5)")
      ->check(CLI::Range(0.1, 3600.0))
      ->group("Job queues");
  run->add_flag("!--no-wait", options.waits, "hand the runs to the queue and end")
      ->group("Job queues");
  return run
      ->add_option("--engine", engine.name, help + " (default: the campaign's engine, else local)")
      ->check(CLI::IsMember(names));
}

void AddRunOptions(CLI::App* run, const Arguments& arguments, const CommandLine& line) {
  EngineOptions& options = arguments->options;
  run->add_option("-j,--jobs", options.jobs,
                  "how many at once; 0: one a processor, or as many as the servers take")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  run->add_option("--timeout", options.timeout, "wall seconds a run may take")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  run->add_option("--failures", options.failures,
                  "a folder in which each failure leaves its recording and a picture; without it "
                  "nothing is recorded");
  CLI::Option* broker =
      run->add_option("--broker", options.broker,
                      "do them on the servers that this broker knows (gsv serve --scenarios N), "
                      "corbaloc::1.2@HOST:PORT/TradingService; without it: here")
          ->excludes("--failures");
  run->add_option("--servers", options.servers,
                  "with --broker: which servers, as a constraint over docs/services.md's "
                  "properties; without it: all")
      ->needs(broker);
  AddEngineOptions(run, arguments)->excludes(broker);
  run->add_option(
      "--shard", arguments->shard,
      "I/N: only the I-th of N shares, for tasks of another queue; status gathers them");
  run->callback([=] { line.exit_code = RunCampaign(*arguments, line.signals); });
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
  AddRunOptions(add("run", "Do all runs that are not done yet; exit code 1 if one did not pass"),
                arguments, line);
  CLI::App* status = add("status", "How many runs are done, and how many passed");
  status->callback([=] { line.exit_code = TellStatusOf(*arguments); });
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
  CLI::App* task = command->add_subcommand("task", "a task of a batch, for a job queue to start");
  task->group("");
  TaskArguments& its = arguments->task;
  task->add_option("file", its.batch_file, "the batch's file")->required();
  task->add_option("--task", its.task, "its number, from 0")->required();
  task->add_option("--job", its.job, "the queue's name for it");
  task->add_option("--node", its.node, "the machine's name");
  task->add_option("--jobs", its.jobs, "runs at once")->check(CLI::Range(1, 256));
  task->add_flag("--until-stdin-closes", its.until_stdin_closes, "end when stdin is closed");
  task->callback([=] { line.exit_code = RunTask(arguments->task, line.signals); });
  CLI::App* run = command->get_subcommand("run");
  for (CLI::App* sub : {run, status, report}) {
    sub->add_option("--results", arguments->results,
                    "the results' file (NAME.sqlite beside the campaign's)");
  }
  for (CLI::App* sub : {run, status}) sub->add_flag("--json", arguments->json, "one JSON object");
}

}  // namespace gsv::app
