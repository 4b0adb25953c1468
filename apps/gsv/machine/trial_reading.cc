#include "apps/gsv/machine/trial_reading.h"

#include <csignal>

#include "apps/gsv/machine/child_process.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"

namespace gsv::app {
namespace {

std::string ExitedWith(int code) { return "exit code " + std::to_string(code); }
std::string EndedBy(int signal) { return "signal " + std::to_string(signal); }

}  // namespace

std::string WhyTrialFailed(const std::string& ending, const TrialLimits& limits) {
  const std::string too_much_time = "reading it takes more than " +
                                    std::to_string(limits.sandbox.processor_time.count()) +
                                    " s of processor time";
  if (ending.empty()) {
    return "reading it takes longer than " + std::to_string(limits.wall_time.count()) + " s";
  }
  if (ending == ExitedWith(kWantsMoreMemory)) {
    return "reading it takes more than " + std::to_string(limits.sandbox.memory_bytes) +
           " bytes of memory";
  }
  if (ending == EndedBy(SIGXCPU)) return too_much_time;
  // The kernel sends SIGKILL at the limit of processor time, but also if the machine has no memory
  // left.
  if (ending == EndedBy(SIGKILL)) return too_much_time + ", or this machine has too little memory";
  return (ending.starts_with("signal") ? "reading it crashes (" : "reading it fails (") + ending +
         ")";
}

base::Status TryToRead(const std::string& world,
                       const std::vector<std::filesystem::path>& model_path,
                       const TrialLimits& limits) {
  std::vector<std::string> arguments{ProgramPath(),
                                     "world",
                                     "check",
                                     world,
                                     "--json",
                                     "--confined-memory",
                                     std::to_string(limits.sandbox.memory_bytes),
                                     "--confined-time",
                                     std::to_string(limits.sandbox.processor_time.count())};
  for (const std::filesystem::path& folder : model_path) {
    arguments.emplace_back("--model-path");
    arguments.push_back(folder);
  }
  auto child = ChildProcess::Start(std::move(arguments), true);
  if (!child) return base::Fail(child.error());
  // Reads and ignores the child's output, because a full pipe would block the child.
  const auto give_up = std::chrono::steady_clock::now() + limits.wall_time;
  const auto left = [&] {
    return std::chrono::ceil<std::chrono::milliseconds>(give_up - std::chrono::steady_clock::now());
  };
  while (left().count() > 0 && (*child)->ReadLine(left())) {
  }
  const std::string ending = left().count() > 0 ? (*child)->AwaitEnd(left()) : (*child)->Ending();
  if (ending == ExitedWith(kOk) || ending == ExitedWith(kBadModel)) return {};
  if (ending.empty()) (*child)->Signal(SIGKILL);
  return base::Fail(base::ErrorCode::kBadModel,
                    WhyTrialFailed(ending, limits) + " (a separate process tried to read it first)",
                    world);
}

}  // namespace gsv::app
