#include "apps/gsv/campaigns/campaign_engines.h"

#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "apps/gsv/campaigns/campaign_commands.h"
#include "apps/gsv/campaigns/campaign_runs.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "gsv/base/host_name.h"
#include "gsv/base/mutex.h"
#include "gsv/base/temporary_folder.h"
#include "gsv/campaign/queue_driver.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;
using campaign::Attempt;
using campaign::RunResult;
using campaign::Spool;

// maximum number of runs that are started on servers or wait for a free slot of a server
constexpr int kRunsWithServers = 64;

int Processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void ReportProgress(const campaign::Progress& progress) {
  if (isatty(STDERR_FILENO) != 1) return;
  std::fprintf(stderr, "\r\033[K%zu of %zu runs, %zu not passed%s", progress.done, progress.planned,
               progress.not_passed,
               progress.seconds_left > 0 && progress.done < progress.planned
                   ? fmt::format(", {:.0f} s left", progress.seconds_left).c_str()
                   : "");
  if (progress.done == progress.planned) std::fputs("\n", stderr);
}

void Say(const std::string& sentence) {
  std::fprintf(stderr, "%sgsv: %s\n", isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "",
               sentence.c_str());
}

bool IsStdinClosed() {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  char bytes[256];
  return poll(&input, 1, 0) > 0 && read(STDIN_FILENO, bytes, sizeof bytes) <= 0;
}

campaign::LocalEngine EngineFor(int jobs, Signals& signals, bool& is_interrupted,
                                bool until_stdin_closes = false) {
  campaign::LocalEngine engine;
  engine.jobs = jobs;
  engine.is_interrupted = [&signals, &is_interrupted, until_stdin_closes] {
    is_interrupted =
        is_interrupted || signals.WaitFor(0) != 0 || (until_stdin_closes && IsStdinClosed());
    return is_interrupted;
  };
  return engine;
}

// Executes `runs`, which are the share `attempt.share` of the campaign's runs, and writes the
// results to a journal. Skips runs that an earlier attempt has finished.
int ExecuteShare(Spool& spool, Attempt attempt, const std::vector<std::int64_t>& runs,
                 const EngineOptions& options, Signals& signals, bool until_stdin_closes = false) {
  const auto earlier = spool.Collect(attempt.share);
  if (!earlier) return PrintError(earlier.error());
  std::set<std::int64_t> done;
  std::size_t not_passed = 0;
  for (const RunResult& result : *earlier) {
    if (done.insert(result.run).second) not_passed += result.status != "passed";
  }
  std::vector<std::int64_t> left;
  for (const std::int64_t run : runs) {
    if (!done.contains(run)) left.push_back(run);
  }
  if (left.empty()) return kOk;
  const auto folder = base::TemporaryFolder::Make("gsv-campaign");
  if (!folder) return PrintError(folder.error());
  attempt.at_once = options.jobs;
  auto journal = campaign::JournalWriter::Create(spool.journals(), attempt);
  if (!journal) return PrintError(journal.error());
  if (!attempt.job.empty()) {
    std::fprintf(stderr, "%s%s\n", std::string(campaign::kTaskBegins).c_str(),
                 attempt.share.c_str());
  }
  const RunExecutor executor(spool.campaign(), folder->path(), options.failures, options.timeout);
  bool is_interrupted = false;
  campaign::LocalEngine engine =
      EngineFor(options.jobs, signals, is_interrupted, until_stdin_closes);
  base::Mutex mutex;
  base::Status written GSV_GUARDED_BY(mutex);
  engine.execute = [&](std::int64_t run,
                       const std::atomic<bool>& is_cancelled) -> std::optional<RunResult> {
    auto ok = (*journal)->Begin(run);
    auto result = ok ? executor.Execute(run, is_cancelled) : std::nullopt;
    if (result) ok = (*journal)->Add(*result);
    const base::MutexLock lock(mutex);
    if (!ok) written = ok;
    return result;
  };
  const auto ended = engine.Execute(left, {runs.size(), done.size(), not_passed},
                                    [&](const std::vector<RunResult>&) {
                                      const base::MutexLock lock(mutex);
                                      return written;
                                    });
  const base::MutexLock lock(mutex);
  if (!ended) return PrintError(ended.error());
  if (!written) return PrintError(written.error());
  if (is_interrupted) return kInterrupted;
  if (auto ok = (*journal)->End(); !ok) return PrintError(ok.error());
  return kOk;
}

}  // namespace

fs::path SpoolOf(const std::string& results_file) {
  return fs::path(results_file).replace_extension(".runs");
}

int GatherSpool(const std::string& results_file) {
  auto spool = Spool::Open(SpoolOf(results_file));
  if (!spool)
    return spool.error().code == base::ErrorCode::kNotFound ? kOk : PrintError(spool.error());
  auto results = campaign::Results::OpenToAdd(results_file, spool->campaign());
  if (!results) {
    return results.error().code == base::ErrorCode::kNotRunning ? kOk : PrintError(results.error());
  }
  const auto gathered = campaign::Gather(*spool, **results);
  return gathered ? kOk : PrintError(gathered.error());
}

int RunHere(const campaign::Campaign& campaign, campaign::Results& results,
            const EngineOptions& options, Signals& signals) {
  const auto folder = base::TemporaryFolder::Make("gsv-campaign");
  if (!folder) return PrintError(folder.error());
  std::unique_ptr<ScenarioServers> servers;
  if (!options.broker.empty()) {
    auto found = ScenarioServers::Find(options.broker, options.servers);
    if (!found) return PrintError(found.error());
    servers = *std::move(found);
  }
  const RunExecutor executor(campaign, folder->path(), options.failures, options.timeout,
                             servers.get());
  bool is_interrupted = false;
  const int jobs = servers != nullptr ? kRunsWithServers : Processors();
  campaign::LocalEngine engine =
      EngineFor(options.jobs > 0 ? options.jobs : jobs, signals, is_interrupted);
  if (servers != nullptr) {
    engine.is_interrupted = [&, asked = std::move(engine.is_interrupted)] {
      return asked() || !servers->failure().empty();
    };
  }
  engine.execute = [&](std::int64_t run, const std::atomic<bool>& is_cancelled) {
    return executor.Execute(run, is_cancelled);
  };
  engine.report = &ReportProgress;
  if (auto ok = engine.Run(results); !ok) return PrintError(ok.error());
  if (!is_interrupted && servers != nullptr && !servers->failure().empty()) {
    return PrintError({base::ErrorCode::kUnavailable, servers->failure()});
  }
  if (!is_interrupted) return kOk;
  Say("interrupted; run the same command again to continue");
  return kInterrupted;
}

int RunByQueue(const campaign::Campaign& campaign, campaign::Results& results,
               const std::string& results_file, const EngineOptions& options, Signals& signals) {
  const campaign::EngineType& type = *options.engine.type;
  if (!options.waits && !type.outlives_driver) {
    return PrintError(
        {base::ErrorCode::kInvalidArgument,
         "the tasks of the engine " + type.name + " end with this command; remove --no-wait",
         "--no-wait"});
  }
  auto spool = Spool::Make(SpoolOf(results_file), campaign);
  if (!spool) return PrintError(spool.error());
  bool is_interrupted = false;
  ChildCommands commands;
  const auto queue = options.engine.make_queue({commands, ProgramPath().string(), &Say});
  campaign::QueueDriver driver{*queue, type.title};
  driver.runs_per_task = options.engine.runs_per_task;
  driver.timeout = options.timeout;
  if (!options.failures.empty()) driver.failures = fs::absolute(options.failures);
  driver.waits = options.waits;
  driver.poll_period = options.poll > 0
                           ? std::chrono::milliseconds(static_cast<int>(1e3 * options.poll))
                           : type.poll_period;
  driver.report = &ReportProgress;
  driver.say = &Say;
  driver.is_interrupted = [&](std::chrono::milliseconds timeout) {
    is_interrupted = signals.WaitFor(static_cast<int>(timeout.count())) != 0;
    return is_interrupted;
  };
  if (auto ok = driver.Run(*spool, results); !ok) return PrintError(ok.error());
  if (!is_interrupted) return kOk;
  Say("interrupted; " + type.after_interrupt +
      (type.outlives_driver ? "; run the same command again to continue to wait for them"
                            : ". Run the same command again to continue"));
  return kInterrupted;
}

int RunShard(const campaign::Campaign& campaign, const std::string& results_file,
             const Shard& shard, const EngineOptions& options, Signals& signals) {
  auto spool = Spool::Make(SpoolOf(results_file), campaign);
  if (!spool) return PrintError(spool.error());
  std::vector<std::int64_t> runs;
  for (std::size_t run = shard.index - 1; run < campaign.runs(); run += shard.count)
    runs.push_back(static_cast<std::int64_t>(run));
  Attempt attempt;
  attempt.share = campaign::ShardName(shard.index, shard.count);
  attempt.node = base::HostName();
  attempt.submitted = attempt.started = campaign::UnixSeconds();
  EngineOptions here = options;
  if (here.jobs == 0) here.jobs = Processors();
  return ExecuteShare(*spool, attempt, runs, here, signals);
}

int RunTask(const TaskArguments& arguments, Signals& signals) {
  Attempt attempt;
  attempt.started = campaign::UnixSeconds();
  const auto batch = campaign::ReadBatch(arguments.batch_file);
  if (!batch) return PrintError(batch.error());
  auto spool = Spool::Open(fs::path(arguments.batch_file).parent_path());
  if (!spool) return PrintError(spool.error());
  if (arguments.task >= batch->tasks()) {
    return PrintError(
        {base::ErrorCode::kInvalidArgument,
         fmt::format("--task must be 0 to {}, found {}", batch->tasks() - 1, arguments.task),
         arguments.batch_file});
  }
  attempt.share = batch->ShareOf(arguments.task);
  attempt.job = arguments.job;
  attempt.node = arguments.node.empty() ? base::HostName() : arguments.node;
  attempt.submitted = batch->submitted;
  EngineOptions options;
  options.timeout = batch->timeout;
  options.failures = batch->failures;
  options.jobs = arguments.jobs;
  return ExecuteShare(*spool, attempt, batch->RunsOf(arguments.task), options, signals,
                      arguments.until_stdin_closes);
}

}  // namespace gsv::app
