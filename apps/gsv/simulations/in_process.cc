#include "apps/gsv/simulations/in_process.h"

#include <cstdlib>
#include <sstream>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/gsv/machine/installation.h"
#include "gsv/hosting/hosted_behaviour.h"
#include "gsv/hosting/plugin.h"

namespace gsv::app {
namespace {

std::vector<std::string> PluginFolders() {
  std::vector<std::string> folders;
  if (const char* path = std::getenv("GSV_PLUGIN_PATH"); path != nullptr) {
    std::istringstream stream(path);
    for (std::string folder; std::getline(stream, folder, ':');) folders.push_back(folder);
  }
  folders.push_back(ProgramFolder() / "../lib/gsv");
  return folders;
}

}  // namespace

base::Result<std::shared_ptr<simulation::BehaviourPort>> InProcessBehaviour(
    const std::string& behaviour) {
  std::vector<std::string> words = SplitWords(behaviour);
  if (words.empty()) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "the name of the behaviour is empty",
                      "--behaviour");
  }
  const std::vector<std::string> folders = PluginFolders();
  const std::string file = hosting::FindPlugin(words.front(), folders);
  if (file.empty()) {
    std::string looked_in;
    for (const std::string& folder : folders) looked_in += (looked_in.empty() ? "" : ", ") + folder;
    return base::Fail(base::ErrorCode::kBehaviour,
                      "there is no plug-in gsv-" + words.front() + ".so in " + looked_in +
                          "; add its folder to GSV_PLUGIN_PATH, or run without --in-process",
                      behaviour);
  }
  const auto module = hosting::LoadPlugin(file);
  if (!module) return base::Fail(module.error());
  CLI::App app;
  BehaviourFactory factory = (*module)->configure(app);
  try {
    app.parse(
        // CLI11 expects the words in reverse order
        std::vector<std::string>(words.rbegin(), words.rend() - 1));
  } catch (const CLI::ParseError& error) {
    return base::Fail(base::ErrorCode::kInvalidArgument, error.what(), "--behaviour " + behaviour);
  }
  return std::make_shared<hosting::HostedBehaviour>(behaviour, std::move(factory));
}

}  // namespace gsv::app
