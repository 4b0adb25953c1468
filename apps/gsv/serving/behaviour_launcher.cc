#include "apps/gsv/serving/behaviour_launcher.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "apps/gsv/machine/installation.h"
#include "gsv/base/sorting.h"
#include "gsv/base/spelling.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/services/behaviour_source.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kStartTimeout{60};
constexpr std::chrono::milliseconds kEndOfOutput{500};
constexpr int kMaxPrograms = 64;

struct FoundProgram {
  std::string path;         // empty if there is no program that can be started
  std::string unstartable;  // the first file with that name that is not executable
};

FoundProgram FindProgram(const std::string& name) {
  FoundProgram found;
  if (name.find('/') != std::string::npos) return found;
  std::vector<fs::path> folders{ProgramFolder()};
  if (const char* path = std::getenv("PATH"); path != nullptr) {
    std::istringstream stream(path);
    for (std::string folder; std::getline(stream, folder, ':');) folders.emplace_back(folder);
  }
  for (const fs::path& folder : folders) {
    const fs::path program = folder / ("gsv-" + name);
    std::error_code ignored;
    if (fs::is_directory(program, ignored)) continue;
    if (access(program.c_str(), X_OK) == 0) {
      found.path = program;
      return found;
    }
    if (found.unstartable.empty() && access(program.c_str(), F_OK) == 0) {
      found.unstartable = program;
    }
  }
  return found;
}

// Returns environment variables for a behaviour program. From these, sdk/serve.cc detects that gsv
// reads stdout, and the program writes stdout and stderr line by line.
std::vector<std::string> CapturedEnvironment() {
  std::vector<std::string> variables{"GSV_OUTPUT_CAPTURED=1"};
  if (std::getenv("PYTHONUNBUFFERED") == nullptr) variables.emplace_back("PYTHONUNBUFFERED=1");
  return variables;
}

base::Error NoProgram(const std::string& behaviour, const std::string& name,
                      const FoundProgram& found, const std::string& broker) {
  const std::string program =
      found.unstartable.empty()
          ? "and there is no program gsv-" + name + " to start"
          : "and the program " + found.unstartable + " is not executable: run chmod +x on it";
  return {base::ErrorCode::kBehaviour,
          "the behaviour is not offered at " + broker + ", " + program +
              "; see `gsv offers`, or start your program with --broker " + broker +
              base::DidYouMean(name, BehaviourPrograms()),
          behaviour};
}

}  // namespace

std::vector<std::string> BehaviourPrograms() {
  constexpr std::string_view kPrefix = "gsv-";
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(ProgramFolder(), ignored)) {
    const std::string file = entry.path().filename();
    if (file.starts_with(kPrefix) && entry.path().extension().empty()) {
      names.push_back(file.substr(kPrefix.size()));
    }
  }
  base::Sort(names);
  return names;
}

BehaviourLauncher::~BehaviourLauncher() {
  output_.ExpectEnds();
  const auto give_up = std::chrono::steady_clock::now() + end_timeout_;
  for (const auto& child : children_) child->Signal(SIGTERM);
  for (const auto& child : children_) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        give_up - std::chrono::steady_clock::now());
    if (child->AwaitEnd(std::max(left, std::chrono::milliseconds(0))).empty()) {
      child->Signal(SIGKILL);
    }
  }
}

base::Status BehaviourLauncher::Ensure(const std::string& behaviour, int programs) {
  if (auto ok = broker_.EnsureServiceType(broker::AgentBehaviourFactoryType()); !ok) return ok;
  auto offers = broker_.Query(broker::AgentBehaviourFactoryType().name,
                              services::ConstraintForName(behaviour), "first", 1);
  if (!offers) return base::Fail(offers.error());
  if (!offers->empty()) return {};
  const std::vector<std::string> words = SplitWords(behaviour);
  const std::string name = words.empty() ? "" : words.front();
  const FoundProgram found = FindProgram(name);
  if (found.path.empty()) {
    return base::Fail(NoProgram(behaviour, name, found, broker_.reference()));
  }
  const std::string& program = found.path;
  std::vector<std::string> command{program,  "--broker", broker_.reference(),
                                   "--name", behaviour,  "--exit-with-parent"};
  command.insert(command.end(), words.begin() + 1, words.end());
  std::vector<ChildProcess*> started;
  for (int i = 0; i < std::min(programs, kMaxPrograms); ++i) {
    auto child = ChildProcess::StartCaptured(command, CapturedEnvironment());
    if (!child) return base::Fail(child.error());
    output_.Begin(**child, behaviour);
    started.push_back(child->get());
    children_.push_back(*std::move(child));
  }
  for (ChildProcess* child : started) {
    if (child->ReadLine(kStartTimeout)) {
      output_.BeginOutput(*child);
      continue;
    }
    // The output of a program may end a moment before the program does, so wait for the end of the
    // program.
    const std::string ending = child->AwaitEnd(kEndOfOutput);
    if (ending.empty()) {
      return base::Fail(base::ErrorCode::kBehaviour, "did not offer its behaviour in time",
                        program);
    }
    const std::string error = output_.LastErrorOf(*child);
    return base::Fail(base::ErrorCode::kBehaviour,
                      "ended at once with " + ending + (error.empty() ? "" : ": " + error),
                      program);
  }
  return {};
}

}  // namespace gsv::app
