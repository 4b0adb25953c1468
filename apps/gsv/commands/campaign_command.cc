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
#include "apps/gsv/process/option_values.h"
#include "gsv/base/counted.h"
#include "gsv/campaign/queue_cost.h"
#include "gsv/campaign/report.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;
using campaign::Campaign;
using campaign::RunResult;

// limit of the wait for another command's lock on the results file
constexpr std::chrono::seconds kLockTimeout{5};

struct CampaignArguments {
  std::string file, results, csv, svg, html, shard;
  std::vector<std::string> by, metrics;
  campaign::EngineRequest engine;
  std::int64_t run = 0;
  bool json = false;
  EngineOptions options;
  TaskArguments task;
};

// The results of FILE.yaml are in FILE.sqlite.
std::string ResultsFile(const CampaignArguments& arguments) {
  if (!arguments.results.empty()) return arguments.results;
  const fs::path file = arguments.file;
  return file.extension() == ".sqlite" ? file : fs::path(file).replace_extension(".sqlite");
}

// Reads the file. Returns kOk, or prints the errors and returns the exit code.
int ReadCampaignFile(const std::string& file, Campaign& campaign,
                     const campaign::EngineRequest& request, campaign::Engine& engine) {
  base::Problems problems;
  auto read = campaign::ReadCampaign(file, problems, request, engine);
  for (const base::Problem& problem : problems) {
    std::fprintf(stderr, "gsv: error: %s\n", problem.Sentence().c_str());
  }
  if (!read) return PrintError(read.error());
  campaign = *std::move(read);
  return problems.empty() ? kOk : kBadModel;
}

// Prints the state of the campaign. Returns the exit code: 1 if a run has not passed.
int PrintStatus(campaign::Results& results, bool json) {
  const auto all = results.All();
  const auto planned = results.PlannedRuns();
  const auto attempts = results.Attempts();
  if (!all || !planned || !attempts)
    return PrintError(!all ? all.error() : !planned ? planned.error() : attempts.error());
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
    std::printf("%zu of %lld runs: %zu passed, %zu failed, %s\n", all->size(),
                static_cast<long long>(*planned), by_status["passed"], by_status["failed"],
                base::Counted(by_status["error"], "error").c_str());
    if (cost) std::printf("%s\n", campaign::Sentence(*cost).c_str());
  }
  return by_status["passed"] == all->size() ? kOk : kAssertionFailed;
}

// Returns where the campaign's runs are executed, in words.
std::string PlaceOfRuns(const CampaignArguments& arguments, const EngineOptions& options) {
  if (!arguments.shard.empty()) return "of a share";
  if (!options.broker.empty()) return "on the servers of a broker";
  return options.engine.type->help;
}

// Returns the first option of the command line that has no effect on this engine, or "".
std::string OptionOfAnotherEngine(const CampaignArguments& arguments, const EngineOptions& options,
                                  bool is_queued) {
  const auto& own = options.engine.type->options;
  for (const auto& [flag, values] : arguments.engine.options) {
    const bool is_own = is_queued && std::any_of(own.begin(), own.end(), [&](const auto& option) {
                          return option.flag == flag;
                        });
    if (!values.empty() && !is_own) return flag;
  }
  if (is_queued) return "";
  if (arguments.engine.runs_per_task > 0) return "--runs-per-task";
  if (options.poll > 0) return "--poll";
  return options.waits ? "" : "--no-wait";
}

int RunCampaign(const CampaignArguments& arguments, Signals& signals) {
  Campaign campaign;
  EngineOptions options = arguments.options;
  if (const int code = ReadCampaignFile(arguments.file, campaign, arguments.engine, options.engine);
      code != kOk) {
    return code;
  }
  const bool is_queued =
      arguments.shard.empty() && options.broker.empty() && options.engine.make_queue;
  if (is_queued && options.jobs > 0) {
    return PrintError({base::ErrorCode::kInvalidArgument,
                       "the engine " + options.engine.type->name +
                           " determines how many runs are executed in parallel; remove the option",
                       fmt::format("--jobs {}", options.jobs)});
  }
  if (const auto option = OptionOfAnotherEngine(arguments, options, is_queued); !option.empty()) {
    // --engine excludes --shard and --broker.
    const bool may_choose = arguments.shard.empty() && options.broker.empty();
    return PrintError({base::ErrorCode::kInvalidArgument,
                       "has no effect on runs " + PlaceOfRuns(arguments, options) +
                           "; remove the option" +
                           (may_choose ? ", or choose its engine with --engine" : ""),
                       option});
  }
  const std::string file = ResultsFile(arguments);
  if (!arguments.shard.empty()) {
    const auto shard = ParseShard(arguments.shard);
    return shard ? RunShard(campaign, file, *shard, options, signals) : PrintError(shard.error());
  }
  if (const int code = GatherSpool(file); code != kOk) return code;
  auto results = campaign::Results::OpenToAdd(file, campaign, kLockTimeout);
  if (!results) return PrintError(results.error());
  const int code = is_queued ? RunByQueue(campaign, **results, file, options, signals)
                             : RunHere(campaign, **results, options, signals);
  if (code != kOk && code != kInterrupted) return code;
  const int verdict = PrintStatus(**results, arguments.json);
  return code == kOk ? verdict : code;
}

int WriteReportFile(const std::string& file, const std::string& text) {
  if (file.empty()) return kOk;
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (stream.flush()) return kOk;
  return PrintError({base::ErrorCode::kUnavailable,
                     "cannot write the report; check the folder and its permissions", file});
}

int PrintStatusOf(const CampaignArguments& arguments) {
  if (const int code = GatherSpool(ResultsFile(arguments)); code != kOk) return code;
  auto results = campaign::Results::Open(ResultsFile(arguments));
  return results ? PrintStatus(**results, arguments.json) : PrintError(results.error());
}

int ReportCampaign(const CampaignArguments& arguments) {
  if (const int code = GatherSpool(ResultsFile(arguments)); code != kOk) return code;
  auto results = campaign::Results::Open(ResultsFile(arguments));
  if (!results) return PrintError(results.error());
  const auto all = (*results)->All();
  const auto parameters = (*results)->Parameters();
  const auto planned = (*results)->PlannedRuns();
  const auto attempts = (*results)->Attempts();
  if (!all || !parameters || !planned || !attempts) {
    return PrintError(!all          ? all.error()
                      : !parameters ? parameters.error()
                      : !planned    ? planned.error()
                                    : attempts.error());
  }
  for (const std::string& parameter : arguments.by) {
    if (std::find(parameters->begin(), parameters->end(), parameter) != parameters->end()) continue;
    return PrintError({base::ErrorCode::kInvalidArgument,
                       "cannot group by this parameter: the campaign does not vary it",
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
    return PrintError({base::ErrorCode::kInvalidArgument,
                       fmt::format("there is no run {}; the runs have the numbers 0 to {}",
                                   arguments.run, campaign.runs() - 1),
                       arguments.file});
  }
  const auto scenario =
      campaign.ScenarioWith(campaign.ValuesOf(static_cast<std::size_t>(arguments.run)));
  if (!scenario) return PrintError(scenario.error());
  std::fputs(scenario->c_str(), stdout);
  return kOk;
}

using SharedArguments = std::shared_ptr<CampaignArguments>;

// Adds `--engine`, the options that all job queues have, and the options of each engine. Returns
// --engine.
CLI::Option* AddEngineOptions(CLI::App* run, const SharedArguments& arguments) {
  EngineOptions& options = arguments->options;
  campaign::EngineRequest& engine = arguments->engine;
  std::vector<std::string> names;
  std::string help;
  for (const campaign::EngineType& type : campaign::EngineTypes()) {
    names.push_back(type.name);
    help += (help.empty() ? "" : "; ") + type.name + ": " + type.help;
    for (const campaign::EngineOption& option : type.options) {
      // another engine has already added an option with this flag
      if (engine.options.contains(option.flag)) continue;
      CLI::Option* added = run->add_option(option.flag, engine.options[option.flag], option.help)
                               ->allow_extra_args(false)
                               ->group(type.title);
      if (!option.is_list) added->take_last();
    }
  }
  run->add_option("--runs-per-task,--runs-a-task", engine.runs_per_task,
                  "runs per task, executed in sequence (default: chosen for at most 1,000 tasks)\n"
                  "--runs-a-task is the former name of this option.")
      ->type_name("N")
      ->check(Between(0, static_cast<int>(campaign::kMaxRuns)))
      ->group("Job queues");
  run->add_option("--poll", options.poll, "polling interval of the queue (default: 10; ssh: 0.5)")
      ->type_name("SECONDS")
      ->check(Between(0.1, 3600.0))
      ->group("Job queues");
  run->add_flag("!--no-wait", options.waits,
                "submit the runs to the queue and do not wait for them")
      ->group("Job queues");
  return run
      ->add_option("--engine", engine.name, help + " (default: the campaign's engine, else local)")
      ->check(OneOf(names));
}

void AddRunOptions(CLI::App* run, const SharedArguments& arguments, const CommandLine& line) {
  EngineOptions& options = arguments->options;
  run->add_option("-j,--jobs", options.jobs,
                  "runs in parallel (default: one per processor; with --broker: up to 64)\n"
                  "Not for job queues, which determine the number themselves.")
      ->check(Between(0, 256))
      ->type_name("N");
  run->add_option("--timeout", options.timeout, "limit of the wall-clock time of a run")
      ->check(Between(1.0, 1e6))
      ->capture_default_str()
      ->type_name("SECONDS");
  run->add_option("--failures", options.failures,
                  "folder for recordings and images of failed runs (default: none)")
      ->type_name("FOLDER");
  CLI::Option* broker =
      run->add_option("--broker", options.broker,
                      "run on the servers of this broker (default: on this machine)\n"
                      "Start each server with `gsv serve --scenarios N`. The address has "
                      "the form corbaloc::1.2@HOST:PORT/TradingService.")
          ->excludes("--failures")
          ->type_name("ADDRESS");
  run->add_option("--servers", options.servers,
                  "servers to use with --broker (default: all)\n"
                  "The value is a constraint over the properties in docs/services.md.")
      ->needs(broker)
      ->type_name("CONSTRAINT");
  CLI::Option* engine = AddEngineOptions(run, arguments)->excludes(broker);
  run->add_option("--shard", arguments->shard,
                  "run only share I (1 to N) of N equal shares of the runs, on this machine\n"
                  "`gsv campaign status` collects the results of all shares.")
      ->excludes(broker)
      ->excludes(engine)
      ->type_name("I/N");
  run->callback([=] { line.exit_code = RunCampaign(*arguments, line.signals); });
}

}  // namespace

void AddCampaignCommand(const CommandLine& line) {
  CLI::App* command =
      line.app.add_subcommand("campaign", "Run a scenario many times with varied parameters");
  command->require_subcommand(1);
  auto arguments = std::make_shared<CampaignArguments>();
  const auto add = [&](const char* name, const char* what) {
    CLI::App* sub = command->add_subcommand(name, what);
    sub->add_option("file", arguments->file, "campaign file, NAME.yaml")->required();
    return sub;
  };
  AddRunOptions(
      add("run", "Execute all runs that have no result yet; exit code 1 if a run does not pass"),
      arguments, line);
  CLI::App* status = add("status", "Print how many runs are done and how many passed");
  status->callback([=] { line.exit_code = PrintStatusOf(*arguments); });
  CLI::App* report = add("report", "Print the results by parameters");
  report->add_option("--by", arguments->by, "parameters to group by, separated by commas")
      ->type_name("NAME,...")
      ->delimiter(',');
  report->add_option("--metric", arguments->metrics, "metric whose mean is printed")
      ->type_name("NAME");
  report->add_option("--csv", arguments->csv, "write all runs as CSV, one per line")
      ->type_name("FILE");
  report->add_option("--svg", arguments->svg, "write the plot as SVG")->type_name("FILE");
  report->add_option("--html", arguments->html, "write a page with plot and table")
      ->type_name("FILE");
  report->callback([=] { line.exit_code = ReportCampaign(*arguments); });
  CLI::App* show = add("show", "Print the scenario of one run, for `gsv run`");
  show->add_option("run", arguments->run, "number of the run, from 0")->required();
  show->callback([=] { line.exit_code = ShowRun(*arguments); });
  CLI::App* task =
      command->add_subcommand("task", "Execute one task of a batch; job queues call this command");
  task->group("");
  TaskArguments& its = arguments->task;
  task->add_option("file", its.batch_file, "file of the batch")->required();
  task->add_option("--task", its.task, "number of the task, from 0")->required();
  task->add_option("--job", its.job, "name of the job in the queue");
  task->add_option("--node", its.node, "name of this machine");
  task->add_option("--jobs", its.jobs, "runs of this task to execute in parallel")
      ->check(Between(1, 256));
  task->add_flag("--until-stdin-closes", its.until_stdin_closes, "end when stdin is closed");
  task->callback([=] { line.exit_code = RunTask(arguments->task, line.signals); });
  CLI::App* run = command->get_subcommand("run");
  for (CLI::App* sub : {run, status, report}) {
    sub->add_option("--results", arguments->results,
                    "results file (default: NAME.sqlite beside the campaign file)")
        ->type_name("FILE");
  }
  for (CLI::App* sub : {run, status})
    sub->add_flag("--json", arguments->json, "print one JSON object");
  run->get_option("--shard")->excludes("--json");  // a share prints no summary
}

}  // namespace gsv::app
