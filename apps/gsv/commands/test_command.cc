#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/machine/child_process.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/simulations/robot_drives.h"
#include "apps/gsv/trials/test_cases.h"
#include "apps/gsv/trials/test_report.h"
#include "gsv/base/counted.h"
#include "gsv/base/mutex.h"

namespace gsv::app {
namespace {

struct TestArguments {
  std::vector<std::string> scenarios;
  std::string junit, shard = "1/1", failures = "gsv-failures";
  TestOptions options;
  int jobs = 0;
  bool json = false, no_record = false, open = false;
};

// Runs all cases, a limited number at a time. Each case has its own thread, which waits for a child
// process.
class TestSession {
 public:
  TestSession(std::vector<TestCase> cases, const TestOptions& options, bool is_talkative)
      : cases_(std::move(cases)),
        options_(options),
        is_talkative_(is_talkative),
        shows_progress_(is_talkative && isatty(STDERR_FILENO) == 1),
        results_(cases_.size()) {
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      results_[i].test = cases_[i];
      results_[i].status = TestResult::Status::kInterrupted;
    }
  }

  std::vector<TestResult> Run(int jobs, Signals& signals) {
    std::vector<std::jthread> threads;
    threads.reserve(static_cast<std::size_t>(jobs));
    for (int i = 0; i < jobs; ++i) threads.emplace_back([this] { Work(); });
    while (!IsDone() && signals.WaitFor(0) == 0) {
      base::MutexLock lock(mutex_);
      done_.wait_for(lock, std::chrono::milliseconds(200),
                     [this]() GSV_REQUIRES(mutex_) { return finished_ == cases_.size(); });
      ShowProgress();
    }
    is_cancelled_ = !IsDone();
    threads.clear();
    ClearProgress();
    const base::MutexLock lock(mutex_);
    return std::move(results_);
  }
  bool is_cancelled() const { return is_cancelled_; }

 private:
  bool IsDone() {
    const base::MutexLock lock(mutex_);
    return finished_ == cases_.size();
  }

  void Work() {
    for (;;) {
      base::MutexLock lock(mutex_);
      if (next_ == cases_.size() || is_cancelled_) return;
      const std::size_t index = next_++;
      running_.push_back(index);
      lock.unlock();
      TestResult result = RunTestCase(cases_[index], options_, is_cancelled_);
      lock.lock();
      std::erase(running_, index);
      ++finished_;
      failed_ += result.status != TestResult::Status::kPassed;
      if (is_talkative_) {
        ClearProgress();
        std::fputs(ToText(result).c_str(), stdout);
        std::fflush(stdout);
      }
      results_[index] = std::move(result);
      done_.notify_all();
    }
  }

  // Shows the progress on the terminal.
  void ShowProgress() GSV_REQUIRES(mutex_) {
    if (!shows_progress_) return;
    std::string names;
    for (const std::size_t index : running_)
      names += (names.empty() ? "" : ", ") + cases_[index].name;
    std::fprintf(stderr, "\r\033[K[%zu/%zu, %zu failed] %.100s", finished_, cases_.size(), failed_,
                 names.c_str());
  }
  void ClearProgress() {
    if (shows_progress_) std::fputs("\r\033[K", stderr);
  }

  const std::vector<TestCase> cases_;
  const TestOptions& options_;
  const bool is_talkative_, shows_progress_;
  std::atomic<bool> is_cancelled_{false};

  base::Mutex mutex_;
  base::ConditionVariable done_;
  std::size_t next_ GSV_GUARDED_BY(mutex_) = 0;
  std::size_t finished_ GSV_GUARDED_BY(mutex_) = 0;
  std::size_t failed_ GSV_GUARDED_BY(mutex_) = 0;
  std::vector<std::size_t> running_ GSV_GUARDED_BY(mutex_);
  std::vector<TestResult> results_ GSV_GUARDED_BY(mutex_);
};

int JobsFor(const TestArguments& arguments, std::size_t cases) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int jobs = arguments.jobs > 0 ? arguments.jobs : cores;
  return std::min(jobs, static_cast<int>(std::max<std::size_t>(cases, 1)));
}

// Replays the recording of the first failure, from its violation on, until a signal arrives.
void OpenFirstFailure(const std::vector<TestResult>& results, Signals& signals) {
  for (const TestResult& result : results) {
    const auto file = std::filesystem::path(result.folder) / "run.mcap";
    std::error_code ignored;
    if (result.folder.empty() || !std::filesystem::exists(file, ignored)) continue;
    std::vector<std::string> command{ProgramPath(), "replay",
                                     "--paused",    "--open",
                                     "--at",        fmt::format("{:g}", result.failed_at)};
    if (!result.about.empty()) command.insert(command.end(), {"--select", result.about});
    command.push_back(file);
    const auto replay = ChildProcess::Start(std::move(command), false);
    if (!replay) {
      PrintError(replay.error());
      return;
    }
    const auto line = (*replay)->ReadLine(std::chrono::seconds(60));
    if (!line) return;  // the viewer has printed the reason on stderr
    std::fprintf(stderr, "%s (the first failure, %s; end with Ctrl-C)\n", line->c_str(),
                 result.test.name.c_str());
    while (signals.WaitFor(100) == 0 && (*replay)->Ending().empty()) {
    }
    return;
  }
  std::fprintf(stderr, "gsv: there is no recording of a failure to open\n");
}

int RunTests(const TestArguments& arguments, Signals& signals) {
  const auto start = std::chrono::steady_clock::now();
  base::Problems problems;
  if (const auto drives = ParseDrives(arguments.options.drives); !drives) {
    return PrintError(drives.error());
  }
  auto cases = FindTestCases(arguments.scenarios, problems);
  if (!cases) return PrintError(cases.error());
  for (const base::Problem& problem : problems) {
    std::fprintf(stderr, "gsv: error: %s\n", problem.Sentence().c_str());
  }
  if (!problems.empty()) return kBadModel;
  const auto shard = ParseShard(arguments.shard);
  if (!shard) return PrintError(shard.error());
  TestOptions options = arguments.options;
  options.failures = arguments.failures;
  options.record = !arguments.no_record;
  auto share = ShareOf(*std::move(cases), *shard);
  const int jobs = JobsFor(arguments, share.size());
  // Concurrent runs are not faster with more threads each.
  if (jobs > 1) options.threads = 1;
  TestSession session(std::move(share), options, !arguments.json);
  const std::vector<TestResult> results = session.Run(jobs, signals);
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!arguments.junit.empty()) {
    std::ofstream file(arguments.junit);
    file << ToJUnit(results, wall);
    if (!file.flush()) {
      return PrintError({base::ErrorCode::kUnavailable,
                         "cannot write the report; check the folder and its permissions",
                         arguments.junit});
    }
  }
  const std::size_t passed = Count(results, TestResult::Status::kPassed);
  if (arguments.json) {
    std::puts(ToJson(results, wall).c_str());
  } else {
    const std::size_t errors = Count(results, TestResult::Status::kError);
    std::printf("%zu passed, %zu failed, %s in %.1f s\n", passed,
                Count(results, TestResult::Status::kFailed), base::Counted(errors, "error").c_str(),
                wall);
  }
  if (session.is_cancelled()) return kInterrupted;
  if (arguments.open) OpenFirstFailure(results, signals);
  if (passed == results.size()) return kOk;
  // Whether every case that did not pass had missing or invalid files.
  const bool is_bad_input = std::all_of(results.begin(), results.end(), [](const auto& result) {
    return result.is_bad_input || result.status == TestResult::Status::kPassed;
  });
  return is_bad_input ? kBadModel : kAssertionFailed;
}

}  // namespace

void AddTestCommand(const CommandLine& line) {
  constexpr const char *kRunGroup = "Runs", *kResultGroup = "Results";
  CLI::App* command = line.app.add_subcommand(
      "test", "Run scenarios as tests; exit code 1 if an expectation is not met");
  auto arguments = std::make_shared<TestArguments>();
  command
      ->add_option("scenarios", arguments->scenarios,
                   "scenario files, or folders of *.yaml and *.yml files")
      ->required();
  command
      ->add_option("-j,--jobs", arguments->jobs,
                   "scenarios to run in parallel (default: one per CPU)")
      ->check(Between(0, 256))
      ->type_name("N")
      ->group(kRunGroup);
  command
      ->add_option("--repeat", arguments->options.repeat,
                   "runs per scenario, which must end in the same state")
      ->check(Between(1, 100'000))
      ->capture_default_str()
      ->type_name("N")
      ->group(kRunGroup);
  command
      ->add_option("--shard", arguments->shard,
                   "run only share I (1 to N) of N equal shares of the scenarios")
      ->capture_default_str()
      ->type_name("I/N")
      ->group(kRunGroup);
  command
      ->add_option("--timeout", arguments->options.timeout, "limit of the wall-clock time of a run")
      ->check(Between(1.0, 1e6))
      ->capture_default_str()
      ->type_name("SECONDS")
      ->group("Limits");
  command
      ->add_option("--drive", arguments->options.drives,
                   "drive of a robot, such as husky=skid,radius=0.16\nEvery scenario must contain "
                   "this robot.")
      ->type_name("ROBOT=KIND[,KEY=VALUE]")
      ->group(kRunGroup);
  command->add_option("--junit", arguments->junit, "write the results as JUnit XML")
      ->type_name("FILE")
      ->group(kResultGroup);
  command
      ->add_option("--failures", arguments->failures,
                   "folder for the recordings, images and output of failed tests")
      ->capture_default_str()
      ->type_name("FOLDER")
      ->group(kResultGroup);
  command
      ->add_option("--keep", arguments->options.kept_seconds,
                   "simulated time to keep in the recording before a violation")
      ->check(Between(0.0, 1e9))
      ->capture_default_str()
      ->type_name("SECONDS")
      ->group(kResultGroup);
  command
      ->add_option("--keep-after", arguments->options.kept_after,
                   "simulated time to keep in the recording after a violation")
      ->check(Between(0.0, 1e9))
      ->capture_default_str()
      ->type_name("SECONDS")
      ->group(kResultGroup);
  command
      ->add_flag("--open", arguments->open,
                 "replay the first failure, from its violation, in a browser\n"
                 "The replay ends with Ctrl-C.")
      ->group(kResultGroup);
  command
      ->add_flag("--no-record", arguments->no_record,
                 "do not record: faster, but failures have no recording")
      ->group(kResultGroup);
  command->add_flag("--json", arguments->json, "print the results as one JSON object only")
      ->group(kResultGroup);
  command->callback([arguments, line] { line.exit_code = RunTests(*arguments, line.signals); });
}

}  // namespace gsv::app
