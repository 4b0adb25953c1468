// Runs one scenario in a child process, so that a crash affects nothing else.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/trials/failure_clips.h"
#include "apps/gsv/trials/prepared_runs.h"
#include "apps/gsv/trials/test_cases.h"
#include "gsv/base/temporary_folder.h"
#include "gsv/base/text_file.h"
#include "gsv/recording/reading/recover.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;
using FloatSeconds = std::chrono::duration<double>;
using TestClock = std::chrono::steady_clock;

constexpr auto kPollPeriod = std::chrono::milliseconds(100);
// A child that has not ended this many seconds after its own timeout is killed.
constexpr double kExtraTime = 30;
constexpr std::size_t kMaxErrorLength = 4000;  // maximum number of characters of the child's errors

struct ChildOutcome {
  std::string ending;  // such as "exit code 0"; empty if it was cancelled
  std::string errors;
  nlohmann::ordered_json report;
};

nlohmann::ordered_json LastLineOf(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t start = text.rfind('\n');
  auto json = nlohmann::ordered_json::parse(text.substr(start == std::string::npos ? 0 : start + 1),
                                            nullptr, false);
  return json.is_object() ? json : nlohmann::ordered_json::object();
}

std::vector<std::string> ArgumentsFor(const TestCase& test, const TestOptions& options,
                                      const fs::path& folder) {
  std::vector<std::string> arguments{test.file,        "--lockstep",
                                     "--headless",     "--json",
                                     "--wall-timeout", fmt::format("{}", options.timeout)};
  if (!options.failures.empty()) {
    arguments.insert(arguments.end(), {"--failure-picture", (folder / "picture.jpg").string()});
  }
  if (options.record) {
    arguments.insert(arguments.end(), {"--record", (folder / "run.mcap").string(), "--record-rate",
                                       "poses=25,pictures=0.2"});
  }
  for (const std::string& drive : options.drives) {
    arguments.insert(arguments.end(), {"--drive", drive});
  }
  arguments.insert(arguments.end(), {"--threads", std::to_string(options.threads)});
  return arguments;
}

// Returns the run server of this thread. A run server ends with the thread that started it, so each
// thread has its own.
PreparedRuns& RunsOfThread() {
  thread_local PreparedRuns runs;
  return runs;
}

base::Result<ChildOutcome> RunChild(const TestCase& test, const TestOptions& options,
                                    const fs::path& folder, const std::atomic<bool>& is_cancelled) {
  PreparedRuns& runs = RunsOfThread();
  if (auto ok =
          runs.Start(ArgumentsFor(test, options, folder), folder / "stdout", folder / "stderr");
      !ok) {
    return base::Fail(ok.error());
  }
  const auto give_up = TestClock::now() + FloatSeconds(options.timeout + kExtraTime);
  ChildOutcome outcome;
  while (outcome.ending.empty() && !is_cancelled && TestClock::now() < give_up) {
    outcome.ending = runs.AwaitEnd(kPollPeriod);
  }
  if (outcome.ending.empty()) runs.Stop();
  if (outcome.ending.empty() && !is_cancelled)
    outcome.ending = "it did not end in time and was killed";
  outcome.errors = base::ReadTextFile(folder / "stderr");
  if (outcome.errors.size() > kMaxErrorLength)
    outcome.errors = "…" + outcome.errors.substr(outcome.errors.size() - kMaxErrorLength);
  outcome.report = LastLineOf(base::ReadTextFile(folder / "stdout"));
  return outcome;
}

// Returns the first robot of the run that the message names.
std::string RobotIn(const nlohmann::ordered_json& report, const std::string& message) {
  for (const auto& robot : report.value("robots", nlohmann::ordered_json::array())) {
    std::string name = robot.value("name", "");
    if (message.find(name) != std::string::npos) return name;
  }
  return {};
}

// Returns the health of the robots that do not move at the end, with one sentence per line.
std::string HealthIn(const nlohmann::ordered_json& report) {
  std::string text;
  for (const auto& robot : report.value("robots", nlohmann::ordered_json::array())) {
    const std::string sentence =
        robot.value("health", nlohmann::ordered_json::object()).value("sentence", "");
    if (sentence.empty()) continue;
    text += (text.empty() ? "" : "\n") + robot.value("name", "") + " " + sentence;
  }
  return text;
}

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

// Returns the violations in the order of their times.
std::string Message(const ChildOutcome& outcome) {
  std::multimap<double, std::string> lines;
  for (const auto& expectation :
       outcome.report.value("expectations", nlohmann::ordered_json::array())) {
    if (expectation.value("holds", true)) continue;
    lines.emplace(expectation.value("time_s", 0.0), expectation.value("where", "") + ": " +
                                                        expectation.value("name", "") + ": " +
                                                        expectation.value("detail", ""));
  }
  std::string message;
  for (const auto& [time, line] : lines) message += (message.empty() ? "" : "\n") + line;
  if (!message.empty() && outcome.ending == "exit code 1") return message;
  message += (message.empty() ? "" : "\n") + ("the run ended with " + outcome.ending);
  return outcome.errors.empty() ? message : message + "\n" + outcome.errors;
}

// Cuts the clips out of the recording of the run. Returns a text for the user with the commands
// that show the clips. The first clip is the file run.mcap, which `gsv rec list` and the viewer
// list.
std::string KeepClips(const fs::path& recording, const fs::path& kept, const TestOptions& options,
                      const std::vector<double>& violations, const std::string& about) {
  std::string text;
  const std::vector<Clip> clips = ClipsOf(violations, options.kept_seconds, options.kept_after);
  std::size_t shown = 0;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    const Clip& clip = clips[i];
    const fs::path file = kept / (i == 0 ? "run.mcap" : fmt::format("run_{}.mcap", i + 1));
    const recording::Selection part{{}, base::FromSeconds(clip.from), base::FromSeconds(clip.to)};
    shown += clip.violations.size();
    if (const auto cut = recording::Recover(recording, file, part); !cut) {
      text += "\nCannot keep the recording: " + cut.error().Sentence() + "\n";
      continue;
    }
    const double at = clip.violations.front();
    const std::string select = about.empty() ? "" : "&select=" + about;
    text += i == 0 ? "\nSee it in the viewer:\n"
                   : fmt::format("\nSee the violation at {:g} s in the viewer:\n", at);
    text += fmt::format(
        "  gsv replay --paused --at {1:g} --open {0}\n"
        "or\n  gsv replay --paused --port 8080 {0}\n  http://127.0.0.1:8080/#t={1:g}{2}\n",
        Quoted(file), at, select);
  }
  if (shown < violations.size()) {
    text +=
        fmt::format("\nNo recording is kept of violations after {:g} s.\n", violations[shown - 1]);
  }
  return text;
}

// Returns the command that repeats a run.
std::string CommandFor(const fs::path& scenario, const TestOptions& options) {
  std::string command =
      "gsv run " + Quoted(fs::absolute(scenario).lexically_normal()) + " --lockstep";
  for (const std::string& drive : options.drives) command += " --drive " + Quoted(drive);
  return command;
}

// Returns the folder for the files of a failed run. Its earlier files may be removed: it is new, or
// KeepFailure() has written it.
fs::path FolderOf(const TestCase& test, const TestOptions& options) {
  const fs::path first = fs::absolute(options.failures) / test.folder;
  fs::path folder = first;
  const auto may_be_replaced = [&] {
    std::error_code ignored;
    return !fs::exists(folder, ignored) || (fs::exists(folder / "README.txt", ignored) &&
                                            fs::exists(folder / "scenario.yaml", ignored));
  };
  for (int i = 2; !may_be_replaced(); ++i) folder = fmt::format("{}_{}", first.string(), i);
  return folder;
}

void ReplaceAll(std::string& text, const std::string& old, const std::string& with) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += with.size()) {
    text.replace(at, old.size(), with);
  }
}

// Keeps the files of a failed run in options.failures. These files are the parts of the recording
// around the violations, the image, the output, and the command that repeats the run.
void KeepFailure(const fs::path& folder, const TestOptions& options, const ChildOutcome& outcome,
                 TestResult& result) {
  const fs::path kept = FolderOf(result.test, options);
  if (result.test.is_temporary) {
    result.command = CommandFor(kept / "scenario.yaml", options);
    ReplaceAll(result.message, result.test.file, (kept / "scenario.yaml").string());
  }
  std::error_code ignored;
  fs::remove_all(kept, ignored);
  fs::create_directories(kept, ignored);
  for (const char* file : {"picture.jpg", "stderr"}) {
    fs::copy_file(folder / file, kept / file, ignored);
  }
  fs::copy_file(result.test.file, kept / "scenario.yaml", ignored);
  const std::vector<double> violations = ViolationTimes(outcome.report);
  result.failed_at = violations.front();
  result.about = RobotIn(outcome.report, result.message);
  std::string text = result.message +
                     "\n\nState hash: " + outcome.report.value("state_hash", "none") +
                     "\nscenario.yaml is a copy of the scenario.\n\nTo repeat the run:\n  " +
                     result.command + "\n";
  if (!result.health.empty()) text += "\nAt the end:\n" + result.health + "\n";
  if (fs::exists(folder / "run.mcap", ignored)) {
    text += KeepClips(folder / "run.mcap", kept, options, violations, result.about);
  }
  if (std::ofstream readme(kept / "README.txt"); !(readme << text << std::flush)) {
    result.message += "\nCannot save the files of the failure in " + kept.string() +
                      "; check the free space of the disk";
  }
  result.folder = kept;
}

TestResult::Status StatusOf(const ChildOutcome& outcome) {
  if (outcome.ending.empty()) return TestResult::Status::kInterrupted;
  if (outcome.ending == "exit code 0") return TestResult::Status::kPassed;
  return outcome.ending == "exit code 1" ? TestResult::Status::kFailed : TestResult::Status::kError;
}

}  // namespace

TestResult RunTestCase(const TestCase& test, const TestOptions& options,
                       const std::atomic<bool>& is_cancelled) {
  const auto start = TestClock::now();
  TestResult result{test};
  result.command = CommandFor(test.file, options);
  for (int i = 0; i < options.repeat; ++i) {
    const auto folder = base::TemporaryFolder::Make("gsv-test");
    const auto outcome =
        folder ? RunChild(test, options, folder->path(), is_cancelled) : base::Fail(folder.error());
    if (!outcome) {
      result.message = outcome.error().Sentence();
      break;
    }
    result.status = StatusOf(*outcome);
    result.is_bad_input = outcome->ending == "exit code 3";
    result.report = outcome->report;
    result.hashes.push_back(outcome->report.value("state_hash", ""));
    if (result.status == TestResult::Status::kPassed && result.hashes.back() != result.hashes[0]) {
      result.status = TestResult::Status::kFailed;
      result.message = fmt::format("run {} ended with state {}, but the first run ended with {}",
                                   i + 1, result.hashes.back(), result.hashes[0]);
    } else if (result.status != TestResult::Status::kPassed) {
      result.message = Message(*outcome);
      result.health = HealthIn(outcome->report);
    }
    if (result.status == TestResult::Status::kPassed) continue;
    if (result.status != TestResult::Status::kInterrupted && !options.failures.empty())
      KeepFailure(folder->path(), options, *outcome, result);
    break;
  }
  result.wall_seconds = FloatSeconds(TestClock::now() - start).count();
  return result;
}

}  // namespace gsv::app
