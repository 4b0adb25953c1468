#include "apps/gsv/serving/behaviour_launcher.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "apps/gsv/machine/installation.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/services/behaviour_source.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kStartTimeout{60};
constexpr int kMaxPrograms = 64;

// Empty when there is none.
std::string FindProgram(const std::string& name) {
  if (name.find('/') != std::string::npos) return {};
  std::vector<fs::path> folders{ProgramFolder()};
  if (const char* path = std::getenv("PATH"); path != nullptr) {
    std::istringstream stream(path);
    for (std::string folder; std::getline(stream, folder, ':');) folders.emplace_back(folder);
  }
  for (const fs::path& folder : folders) {
    const fs::path program = folder / ("gsv-" + name);
    if (access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

}  // namespace

base::Status BehaviourLauncher::Ensure(const std::string& behaviour, int programs) {
  if (auto ok = broker_.EnsureServiceType(broker::AgentBehaviourFactoryType()); !ok) return ok;
  auto offers = broker_.Query(broker::AgentBehaviourFactoryType().name,
                              services::ConstraintForName(behaviour), "first", 1);
  if (!offers) return base::Fail(offers.error());
  if (!offers->empty()) return {};
  const std::vector<std::string> words = SplitWords(behaviour);
  const std::string name = words.empty() ? "" : words.front();
  const std::string program = FindProgram(name);
  if (program.empty()) {
    return base::Fail(base::ErrorCode::kBehaviour,
                      "no such behaviour is offered at " + broker_.reference() +
                          ", and there is no program gsv-" + name +
                          " to start; see `gsv offers`, or start your program with --broker " +
                          broker_.reference(),
                      behaviour);
  }
  std::vector<std::string> command{program,  "--broker", broker_.reference(),
                                   "--name", behaviour,  "--exit-with-parent"};
  command.insert(command.end(), words.begin() + 1, words.end());
  std::vector<ChildProcess*> started;
  for (int i = 0; i < std::min(programs, kMaxPrograms); ++i) {
    auto child = ChildProcess::Start(command, false);
    if (!child) return base::Fail(child.error());
    started.push_back(child->get());
    children_.push_back(*std::move(child));
  }
  for (ChildProcess* child : started) {
    if (child->ReadLine(kStartTimeout)) continue;
    const std::string ending = child->Ending();
    return base::Fail(
        base::ErrorCode::kBehaviour,
        ending.empty() ? "did not offer its behaviour in time" : "ended at once with " + ending,
        program);
  }
  return {};
}

}  // namespace gsv::app
