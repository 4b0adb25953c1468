#include "apps/gsv/trials/campaign_engines.h"

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include <fmt/format.h>

#include "apps/gsv/exit_code.h"
#include "apps/gsv/machine/child_process.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/trials/campaign_runs.h"
#include "gsv/base/host_name.h"
#include "gsv/base/temporary_folder.h"
#include "gsv/campaign/slurm_engine.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;
using campaign::Attempt;
using campaign::RunResult;
using campaign::Spool;

constexpr std::chrono::seconds kCommandPatience{60};
constexpr int kRunsWithServers = 64;  // at once, waiting for room included

std::string Environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

int Processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void TellProgress(const campaign::Progress& progress) {
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

base::Result<campaign::CommandOutcome> RunCommand(const std::vector<std::string>& command) {
  std::vector<std::string> line{"/bin/sh", "-c", "exec \"$@\" 2>&1", "sh"};
  line.insert(line.end(), command.begin(), command.end());
  auto child = ChildProcess::Start(std::move(line), false);
  if (!child) return base::Fail(child.error());
  const auto give_up = std::chrono::steady_clock::now() + kCommandPatience;
  const auto left = [&] {
    return std::max(std::chrono::milliseconds(0),
                    std::chrono::duration_cast<std::chrono::milliseconds>(
                        give_up - std::chrono::steady_clock::now()));
  };
  campaign::CommandOutcome outcome;
  while (const auto text = (*child)->ReadLine(left())) outcome.output += *text + "\n";
  outcome.ending = (*child)->AwaitEnd(left());
  if (!outcome.ending.empty()) return outcome;
  return base::Fail(base::ErrorCode::kTimeout,
                    fmt::format("did not answer within {} s; is Slurm up? The same command goes on",
                                kCommandPatience.count()),
                    command.front());
}

campaign::LocalEngine EngineFor(int jobs, Signals& signals, bool& is_interrupted) {
  campaign::LocalEngine engine;
  engine.jobs = jobs;
  engine.is_interrupted = [&] {
    is_interrupted = is_interrupted || signals.WaitFor(0) != 0;
    return is_interrupted;
  };
  return engine;
}

// Takes those of the runs that no earlier attempt at the share has done, and writes a journal.
int TakeShare(Spool& spool, Attempt attempt, const std::vector<std::int64_t>& runs,
              const EngineOptions& options, Signals& signals) {
  const auto earlier = spool.Collect(attempt.share);
  if (!earlier) return Complain(earlier.error());
  std::set<std::int64_t> done;
  for (const RunResult& result : *earlier) done.insert(result.run);
  std::vector<std::int64_t> left;
  for (const std::int64_t run : runs) {
    if (!done.contains(run)) left.push_back(run);
  }
  if (left.empty()) return kOk;
  const auto folder = base::TemporaryFolder::Make("gsv-campaign");
  if (!folder) return Complain(folder.error());
  attempt.at_once = options.jobs;
  auto journal = campaign::JournalWriter::Create(spool.journals(), attempt);
  if (!journal) return Complain(journal.error());
  const RunTaker taker(spool.campaign(), folder->path(), options.failures, options.timeout);
  bool is_interrupted = false;
  campaign::LocalEngine engine = EngineFor(options.jobs, signals, is_interrupted);
  std::mutex mutex;
  base::Status written;  // guarded by mutex
  engine.take = [&](std::int64_t run,
                    const std::atomic<bool>& is_cancelled) -> std::optional<RunResult> {
    auto ok = (*journal)->Begin(run);
    auto result = ok ? taker.Take(run, is_cancelled) : std::nullopt;
    if (result) ok = (*journal)->Add(*result);
    const std::lock_guard lock(mutex);
    if (!ok) written = ok;
    return result;
  };
  const auto ended =
      engine.Take(left, {runs.size(), done.size()}, [&](const std::vector<RunResult>&) {
        const std::lock_guard lock(mutex);
        return written;
      });
  const std::lock_guard lock(mutex);
  if (!ended) return Complain(ended.error());
  if (!written) return Complain(written.error());
  if (is_interrupted) return kInterrupted;
  if (auto ok = (*journal)->End(); !ok) return Complain(ok.error());
  return kOk;
}

std::string NodeName() {
  const std::string node = Environment("SLURMD_NODENAME");
  return node.empty() ? base::HostName() : node;
}

}  // namespace

fs::path SpoolOf(const std::string& results_file) {
  return fs::path(results_file).replace_extension(".runs");
}

int GatherSpool(const std::string& results_file) {
  auto spool = Spool::Open(SpoolOf(results_file));
  if (!spool)
    return spool.error().code == base::ErrorCode::kNotFound ? kOk : Complain(spool.error());
  auto results = campaign::Results::OpenToAdd(results_file, spool->campaign());
  if (!results) {
    return results.error().code == base::ErrorCode::kNotRunning ? kOk : Complain(results.error());
  }
  const auto gathered = campaign::Gather(*spool, **results);
  return gathered ? kOk : Complain(gathered.error());
}

int RunHere(const campaign::Campaign& campaign, campaign::Results& results,
            const EngineOptions& options, Signals& signals) {
  const auto folder = base::TemporaryFolder::Make("gsv-campaign");
  if (!folder) return Complain(folder.error());
  std::unique_ptr<ScenarioServers> servers;
  if (!options.broker.empty()) {
    auto found = ScenarioServers::Find(options.broker, options.servers);
    if (!found) return Complain(found.error());
    servers = *std::move(found);
  }
  const RunTaker taker(campaign, folder->path(), options.failures, options.timeout, servers.get());
  bool is_interrupted = false;
  const int jobs = servers != nullptr ? kRunsWithServers : Processors();
  campaign::LocalEngine engine =
      EngineFor(options.jobs > 0 ? options.jobs : jobs, signals, is_interrupted);
  if (servers != nullptr) {
    engine.is_interrupted = [&, asked = std::move(engine.is_interrupted)] {
      return asked() || !servers->failure().empty();
    };
  }
  engine.take = [&](std::int64_t run, const std::atomic<bool>& is_cancelled) {
    return taker.Take(run, is_cancelled);
  };
  engine.tell = &TellProgress;
  if (auto ok = engine.Run(results); !ok) return Complain(ok.error());
  if (!is_interrupted && servers != nullptr && !servers->failure().empty()) {
    return Complain({base::ErrorCode::kUnavailable, servers->failure()});
  }
  if (!is_interrupted) return kOk;
  Say("interrupted; the same command goes on where this stopped");
  return kInterrupted;
}

int RunBySlurm(const campaign::Campaign& campaign, campaign::Results& results,
               const std::string& results_file, const EngineOptions& options, Signals& signals) {
  auto spool = Spool::Make(SpoolOf(results_file), campaign);
  if (!spool) return Complain(spool.error());
  bool is_interrupted = false;
  campaign::SlurmEngine engine{
      campaign::SlurmQueue(&RunCommand, options.engine.slurm, ProgramPath().string())};
  engine.runs_a_task = options.engine.slurm.runs_a_task;
  engine.timeout = options.timeout;
  if (!options.failures.empty()) engine.failures = fs::absolute(options.failures);
  engine.waits = options.waits;
  engine.look_period = std::chrono::milliseconds(static_cast<int>(1e3 * options.poll));
  engine.tell = &TellProgress;
  engine.say = &Say;
  engine.is_interrupted = [&](std::chrono::milliseconds patience) {
    is_interrupted = signals.WaitFor(static_cast<int>(patience.count())) != 0;
    return is_interrupted;
  };
  if (auto ok = engine.Run(*spool, results); !ok) return Complain(ok.error());
  if (!is_interrupted) return kOk;
  Say("interrupted; what Slurm has goes on (scancel --name ends it), and so does the same command");
  return kInterrupted;
}

int RunShard(const campaign::Campaign& campaign, const std::string& results_file,
             const Shard& shard, const EngineOptions& options, Signals& signals) {
  auto spool = Spool::Make(SpoolOf(results_file), campaign);
  if (!spool) return Complain(spool.error());
  std::vector<std::int64_t> runs;
  for (std::size_t run = shard.index - 1; run < campaign.runs(); run += shard.count)
    runs.push_back(static_cast<std::int64_t>(run));
  Attempt attempt;
  attempt.share = campaign::ShardName(shard.index, shard.count);
  attempt.node = NodeName();
  attempt.submitted = attempt.started = campaign::WallSeconds();
  EngineOptions here = options;
  if (here.jobs == 0) here.jobs = Processors();
  return TakeShare(*spool, attempt, runs, here, signals);
}

int RunTask(const std::string& batch_file, Signals& signals) {
  Attempt attempt;
  attempt.started = campaign::WallSeconds();
  const auto batch = campaign::ReadBatch(batch_file);
  if (!batch) return Complain(batch.error());
  auto spool = Spool::Open(fs::path(batch_file).parent_path());
  if (!spool) return Complain(spool.error());
  const std::string index = Environment("SLURM_ARRAY_TASK_ID");
  char* end = nullptr;
  const unsigned long task = std::strtoul(index.c_str(), &end, 10);
  if (index.empty() || *end != '\0' || task >= batch->tasks()) {
    return Complain({base::ErrorCode::kInvalidArgument,
                     fmt::format("Slurm starts this, with SLURM_ARRAY_TASK_ID from 0 to {}; it is "
                                 "\"{}\"",
                                 batch->tasks() - 1, index),
                     batch_file});
  }
  attempt.share = batch->ShareOf(task);
  attempt.job = Environment("SLURM_ARRAY_JOB_ID");
  if (attempt.job.empty()) attempt.job = "none";
  attempt.node = NodeName();
  attempt.submitted = batch->submitted;
  EngineOptions options;
  options.timeout = batch->timeout;
  options.failures = batch->failures;
  options.jobs = std::max(1, std::atoi(Environment("SLURM_CPUS_PER_TASK").c_str()));
  return TakeShare(*spool, attempt, batch->RunsOf(task), options, signals);
}

}  // namespace gsv::app
