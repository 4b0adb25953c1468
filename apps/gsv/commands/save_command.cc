// gsv world save: saves the current world of a running simulation as files.
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/commands/selection_options.h"
#include "apps/gsv/process/exit_code.h"
#include "gsv/base/atomic_file.h"
#include "gsv/base/log.h"
#include "gsv/gateway/upstream/fetch.h"

namespace gsv::app {
namespace {

using SavedJson = nlohmann::json;

struct SaveArguments {
  std::string output, scenario, token, authority;
  Selection selection;
};

std::string SavedText(const SavedJson& json, const char* key) {
  const auto found = json.is_object() ? json.find(key) : json.end();
  const bool is_text = json.is_object() && found != json.end() && found->is_string();
  return is_text ? found->get<std::string>() : std::string();
}

base::Result<SavedJson> AskForWorld(const SaveArguments& arguments) {
  const auto found = FindOneSimulation(arguments.selection);
  if (!found) return base::Fail(found.error());
  if (found->server.viewer_url.empty()) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "cannot be saved: it runs without a viewer. Start it without --headless",
                      found->server.Describe());
  }
  auto address = gateway::upstream::ParseAddress(found->server.viewer_url, arguments.authority);
  if (!address) return base::Fail(address.error());
  address->token = arguments.token;
  gateway::Request request;
  request.method = "GET";
  request.raw_target =
      fmt::format("/api/simulations/{}/world?file={}", gateway::Escape(found->status.name),
                  gateway::Escape(std::filesystem::path(arguments.output).filename().string()));
  const auto response = gateway::upstream::Fetch(*address, request, std::chrono::seconds(60));
  if (!response) return base::Fail(response.error());
  SavedJson json = SavedJson::parse(response->body.view(), nullptr, false);
  if (response->status == 200 && !SavedText(json, "sdf").empty()) return json;
  const std::string sentence = SavedText(json, "error");
  return base::Fail(
      response->status == 404 ? base::ErrorCode::kNotFound : base::ErrorCode::kUnavailable,
      sentence.empty() ? fmt::format("the server answered with the status {}; its version of GSV "
                                     "may be too old to save worlds",
                                     response->status)
                       : sentence);
}

base::Status WriteSaved(const SaveArguments& arguments) {
  const auto saved = AskForWorld(arguments);
  if (!saved) return base::Fail(saved.error());
  if (const auto warnings = saved->find("warnings"); warnings != saved->end()) {
    for (const SavedJson& warning : *warnings) {
      if (warning.is_string()) {
        std::fprintf(stderr, "warning: %s\n", warning.get<std::string>().c_str());
      }
    }
  }
  if (auto ok = base::WriteAtomically(arguments.output, SavedText(*saved, "sdf"),
                                      base::Durability::kProcess);
      !ok) {
    return ok;
  }
  std::printf("%s\n", arguments.output.c_str());
  if (arguments.scenario.empty()) return {};
  const auto written = base::WriteAtomically(arguments.scenario, SavedText(*saved, "scenario"),
                                             base::Durability::kProcess);
  if (written) std::printf("%s\n", arguments.scenario.c_str());
  return written;
}

}  // namespace

void AddSaveCommand(const CommandLine& line) {
  CLI::App* command = line.app.get_subcommand("world")->add_subcommand(
      "save", "Save the current world of a running simulation as SDFormat");
  auto arguments = std::make_shared<SaveArguments>();
  command->add_option("simulation", arguments->selection.simulation,
                      "running simulation (default: that of your newest instance)");
  command->add_option("-o,--output", arguments->output, "world file to write")
      ->type_name("FILE")
      ->required();
  command
      ->add_option("--scenario", arguments->scenario,
                   "also write a scenario of this world, with the behaviours of its robots")
      ->type_name("FILE");
  AddInstanceOptions(*command, arguments->selection);
  command->add_option("--token", arguments->token, "control or watch token of the server")
      ->type_name("TOKEN")
      ->envname("GSV_TOKEN");
  command
      ->add_option("--authority", arguments->authority,
                   "certificate authority of the server, PEM (default: the system's)")
      ->type_name("FILE");
  command->callback([arguments, line] {
    base::RedactInLog(arguments->token);
    if (const auto saved = WriteSaved(*arguments); !saved)
      line.exit_code = PrintError(saved.error());
  });
}

}  // namespace gsv::app
