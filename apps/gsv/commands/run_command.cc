#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/problem_report.h"
#include "apps/gsv/running/browser.h"
#include "apps/gsv/running/drive_options.h"
#include "apps/gsv/running/edit_repetition.h"
#include "apps/gsv/running/image_file.h"
#include "apps/gsv/running/run.h"
#include "apps/gsv/running/run_population.h"
#include "apps/gsv/running/run_report.h"
#include "apps/gsv/running/run_server.h"
#include "apps/gsv/simulations/recordings.h"
#include "apps/gsv/simulations/robot_drives.h"
#include "gsv/base/counted.h"
#include "gsv/base/log.h"
#include "gsv/base/sorting.h"
#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/topics/topics.h"
#include "gsv/verdict/judge.h"

namespace gsv::app {
namespace {

using simulation::Phase;
using simulation::Simulation;

// The number of different warnings that are printed; `gsv world check` prints all.
constexpr std::size_t kWarningsPrinted = 10;

bool PrintErrors(const base::Problems& problems) {
  const auto errors = GroupedSentences(problems, base::Problem::Severity::kError);
  for (const std::string& error : errors) std::fprintf(stderr, "gsv: error: %s\n", error.c_str());
  return !errors.empty();
}

// Whether the last of the events "started", "stopped" and "reset" is "stopped". A reset also stops
// the simulation, but does not end the command.
bool WasStopped(const Simulation& simulation) {
  const auto events = simulation.events(0);
  const auto last = std::find_if(events.rbegin(), events.rend(), [](const auto& event) {
    return event.kind == "started" || event.kind == "stopped" || event.kind == "reset";
  });
  return last != events.rend() && last->kind == "stopped";
}

// Waits until the run is over or a signal interrupts it. Returns the exit code, which the
// results of behaviours and expectations may still change.
int Await(Runtime& runtime, Simulation& simulation, const RunOptions& options, Signals& signals) {
  using WaitClock = std::chrono::steady_clock;
  const auto give_up = WaitClock::now() + std::chrono::duration_cast<WaitClock::duration>(
                                              std::chrono::duration<double>(options.wall_timeout));
  // If there is a viewer, a user may stop the run, reset it and start it again.
  const bool ends_when_stopped = !options.runtime.viewer;
  for (;;) {
    const Phase phase =
        simulation.WaitForPhase({Phase::kFinished, Phase::kFailed}, std::chrono::milliseconds(50));
    if (phase == Phase::kFinished) return kOk;
    if (phase == Phase::kFailed) return kBehaviourFailed;
    if (phase == Phase::kStopped && ends_when_stopped && WasStopped(simulation)) return kOk;
    if (signals.WaitFor(0) != 0) {
      runtime.EndSoon();
      (void)simulation.Stop();
      return kInterrupted;
    }
    if (options.wall_timeout > 0 && WaitClock::now() > give_up) {
      std::fprintf(stderr, "gsv: aborted after %g s of wall-clock time (--wall-timeout)\n",
                   options.wall_timeout);
      runtime.EndSoon();
      (void)simulation.Stop();
      return kTimedOut;
    }
  }
}

// Whether a fault in the scenario can be the cause of the behaviour's end, because the fault stops
// the behaviour or a sensor.
bool IsEndByFault(const Simulation& simulation, const std::string& robot) {
  const auto& faults = simulation.specification().faults;
  return std::any_of(faults.begin(), faults.end(), [&](const scenario::Fault& fault) {
    return fault.body == robot && (fault.kind == scenario::Fault::Kind::kBehaviourDies ||
                                   fault.kind == scenario::Fault::Kind::kSensorError);
  });
}

// Prints a line for each behaviour that has failed. Returns kBehaviourFailed if `exit_code` is kOk
// and a behaviour has failed, else `exit_code`.
int JudgeBehaviours(const Simulation& simulation, int exit_code) {
  const auto status = simulation.status();
  for (const auto& robot : status.robots) {
    if (IsEndByFault(simulation, robot.name)) continue;
    if (robot.phase != simulation::AgentPhase::kDead &&
        robot.phase != simulation::AgentPhase::kUnresponsive)
      continue;
    std::fprintf(stderr, "gsv: %s: the behaviour %s is %s: %s\n", robot.name.c_str(),
                 robot.behaviour.c_str(), ToString(robot.phase), robot.detail.c_str());
    if (exit_code == kOk) exit_code = kBehaviourFailed;
  }
  if (!status.failure.empty())
    std::fprintf(stderr, "gsv: the run failed: %s\n", status.failure.c_str());
  return exit_code;
}

void Warn(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) {
    std::fprintf(stderr, "gsv: warning: %s\n", sentence.c_str());
  }
}

// Returns one sentence for each selected topic that never existed. A robot that was added during
// the run may have added topics that did not exist at the start.
std::vector<std::string> ProblemsAtTheEnd(const RunOptions& options,
                                          std::vector<std::string> topics_at_start) {
  const auto recorded = recording::McapReader::Open(options.record);
  if (!recorded) return {};  // the disk failed, which was reported already
  for (const auto& [id, channel] : (*recorded)->summary().channels) {
    topics_at_start.push_back(channel.topic);
  }
  base::Sort(topics_at_start);
  topics_at_start.erase(std::unique(topics_at_start.begin(), topics_at_start.end()),
                        topics_at_start.end());
  return ProblemsOf(options.recording, topics_at_start);
}

// Prints the violated expectations, and renders an image at the first violation.
int JudgeExpectations(verdict::Judge& judge, const RunOptions& options,
                      std::vector<verdict::Finding>& findings, int exit_code) {
  findings = judge.Finish();
  const verdict::Finding* first = nullptr;
  for (const verdict::Finding& finding : findings) {
    if (finding.holds) continue;
    std::fprintf(stderr, "gsv: %s: %s: %s\n", finding.where.c_str(), finding.name.c_str(),
                 finding.Sentence().c_str());
    if (first == nullptr || finding.step < first->step) first = &finding;
  }
  if (first == nullptr) return exit_code;
  if (!options.failure_image.empty()) {
    std::string about;
    for (const auto& measured : first->atoms) {
      if (about.empty()) about = measured.atom.quantity.first;
    }
    if (auto ok = DrawAround(judge.first_violation(), about, options.failure_image); !ok)
      Warn({ok.error().Sentence()});
  }
  return exit_code == kOk ? kAssertionFailed : exit_code;
}

}  // namespace

base::Result<int> Run(const RunOptions& given, Signals& signals, bool is_quiet) {
  RunOptions options = given;
  if (PrintErrors(options.problems)) return kBadModel;
  const auto world = FindWorld(options.scenario.world);
  if (!world) return base::Fail(world.error());
  auto runtime = Runtime::Start(options.runtime);
  if (!runtime) return base::Fail(runtime.error());
  base::Problems problems;
  auto& library = (*runtime)->host().library();
  if (auto ok = PrepareDrives(*world, library, options, problems); !ok)
    return base::Fail(ok.error());
  if (options.specification.world == nullptr && options.prepared_world != nullptr) {
    options.specification.world = options.prepared_world->description;
    problems = options.prepared_world->problems;
  }
  auto simulation = (*runtime)->host().Create(options.specification, *world, problems);
  if (!simulation) return base::Fail(simulation.error());
  (*runtime)->recordings().SetSimulationOfCommand(*simulation);
  auto told = PopulateRun(**runtime, **simulation, options, problems);
  if (!told) return base::Fail(told.error());

  if (PrintErrors(problems)) return kBadModel;
  problems.insert(problems.begin(), options.problems.begin(), options.problems.end());
  auto warnings = GroupedSentences(problems, base::Problem::Severity::kWarning);
  Warn(Shortened(warnings, kWarningsPrinted,
                 "to see all: gsv world check " + options.scenario.world));
  if (options.is_strict && !warnings.empty()) {
    std::fprintf(stderr, "gsv: the run is refused because of --strict: %s\n",
                 base::Counted(warnings.size(), "warning").c_str());
    return kBadModel;
  }

  for (const simulation::Event& event : (*simulation)->events(0)) {
    if (event.kind == "robot_moved" && !is_quiet)
      std::fprintf(stderr, "gsv: note: %s: %s\n", event.robot.c_str(), event.detail.c_str());
  }

  if (!is_quiet) {
    for (const std::string& note : DriveNotes(**simulation)) {
      std::fprintf(stderr, "gsv: note: %s\n", note.c_str());
    }
  }
  auto judge = verdict::Judge::Attach(options.scenario.expect, **simulation);
  if (!judge) return base::Fail(judge.error());
  std::FILE* const notes = options.json ? stderr : stdout;
  if (options.runtime.has_broker) {
    if (auto ok = (*runtime)->OfferService("gsv run"); !ok) return base::Fail(ok.error());
  }
  if (const std::string& url = (*runtime)->viewer_url(); !url.empty()) {
    std::fprintf(notes, "viewer: %s\n", url.c_str());
    if (options.open_browser) OpenBrowser(url);
  }
  // With a viewer, the broker's address is not printed: only programs need it, and they can get it
  // from `gsv ps --json`.
  const bool shows_broker =
      (*runtime)->viewer_url().empty() || spdlog::should_log(spdlog::level::debug);
  if (options.runtime.has_broker && !is_quiet && shows_broker)
    std::fprintf(notes, "broker: %s\n", (*runtime)->broker().reference().c_str());
  if (Ros2Access* const access = (*runtime)->ros2()) {
    access->Publish(*simulation);
    if (!is_quiet) std::fprintf(notes, "ros2: %s\n", access->Description().c_str());
    if (const std::string why = access->Exposure(); !why.empty()) Warn({why});
  }
  std::fflush(notes);
  std::vector<std::string> topics;  // the topics that can be recorded
  if (!options.record.empty()) {
    topics = recording::TopicsOf(**simulation);
    Warn(ProblemsOf(options.recording, topics));
    RecordingChoice choice = options.recording;
    choice.scenario = *std::move(told);
    if (auto ok = (*runtime)->recordings().Start(*simulation, options.record, choice); !ok)
      return base::Fail(ok.error());
  }
  const auto started = RunWithEdits(**runtime, **simulation, options, signals);
  if (!started || *started != kOk) return started;
  int exit_code = JudgeBehaviours(**simulation, Await(**runtime, **simulation, options, signals));
  std::vector<verdict::Finding> findings;
  if (is_quiet) {
    (void)(*judge)->Finish();
  } else {
    exit_code = JudgeExpectations(**judge, options, findings, exit_code);
  }
  if (options.runtime.has_broker) (*runtime)->launcher().WaitForOutput();
  if (auto ok = (*runtime)->recordings().StopAll(); !ok) exit_code = PrintError(ok.error());
  if (is_quiet) return exit_code;
  if (!options.recording.topics.empty()) {
    for (std::string& sentence : ProblemsAtTheEnd(options, std::move(topics))) {
      warnings.push_back(std::move(sentence));
    }
  }
  const std::string report = options.json ? JsonReport(**simulation, warnings, findings) + "\n"
                                          : TextReport(**simulation, findings);
  std::fputs(report.c_str(), stdout);
  std::fflush(stdout);
  return exit_code;
}

void AddRunCommand(const CommandLine& line) {
  CLI::App* command = line.app.add_subcommand(
      "run", "Run a simulation: a world, robots, their behaviours, a viewer");
  auto arguments = std::make_shared<RunArguments>();
  AddRunOptions(*command, *arguments);
  command->callback([arguments, line] {
    const auto options = ParseArguments(*arguments);
    if (!options) {
      line.exit_code = PrintError(options.error());
      return;
    }
    const auto result = Run(*options, line.signals);
    line.exit_code = result ? *result : PrintError(result.error());
  });
  // This command is for `gsv test` and campaigns, and is hidden in lists of commands.
  CLI::App* server =
      line.app.add_subcommand("run-server", "Run the simulations that are requested on stdin")
          ->group("");
  // The arguments are ignored. They only reserve memory in which the process writes the command
  // line of each run, because `ps` shows this memory (running/run_server.cc).
  server->allow_extras();
  server->callback([line] { line.exit_code = ServeRuns(line.signals); });
}

}  // namespace gsv::app
