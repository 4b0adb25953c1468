#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include "apps/gsv/commands.h"
#include "apps/gsv/exit_code.h"
#include "apps/gsv/installation.h"
#include "gsv/gateway/replay_gateway.h"
#include "gsv/recording/recording_info.h"
#include "gsv/recording/recover.h"
#include "gsv/recording/scene_attachments.h"

namespace gsv::app {
namespace {

struct RecordingArguments {
  std::string file, output;
  bool json = false;
};

// A recording that is not there is no bad model.
int Refuse(const base::Error& error) {
  const int code = Complain(error);
  return error.code == base::ErrorCode::kNotFound ? kInfrastructure : code;
}

int Info(const RecordingArguments& arguments) {
  const auto info = recording::ReadInfo(arguments.file);
  if (!info) return Refuse(info.error());
  const std::string text =
      arguments.json ? recording::ToJson(*info) + "\n" : recording::ToText(*info);
  std::fputs(text.c_str(), stdout);
  return kOk;
}

int Recover(const RecordingArguments& arguments) {
  const auto recovery = recording::Recover(arguments.file, arguments.output);
  if (!recovery) return Refuse(recovery.error());
  const std::string text =
      arguments.json ? recording::ToJson(*recovery) + "\n" : recording::ToText(*recovery);
  std::fputs(text.c_str(), stdout);
  return kOk;
}

struct ReplayArguments {
  std::string file;
  int port = -1;  // none was given
  gateway::ReplayOptions options;
  bool headless = false;
  bool paused = false;
  bool json = false;
};

// Reads the whole file, every message in its turn, and tells what a replay would have shown.
int CheckReplay(const ReplayArguments& arguments) {
  const auto info = recording::ReadInfo(arguments.file);
  if (!info) return Refuse(info.error());
  std::uint64_t scenes = 0, models = 0;
  for (const auto& file : info->attachments) {
    if (file.name == recording::kSceneAttachment) ++scenes;
    if (file.name.starts_with("models/")) ++models;
  }
  nlohmann::ordered_json warnings = nlohmann::ordered_json::array();
  for (const base::Problem& problem : info->problems) warnings.push_back(problem.Sentence());
  const bool is_whole = !info->content_hash.empty();
  if (arguments.json) {
    const nlohmann::ordered_json json{{"file", info->path},
                                      {"start_s", base::ToSeconds(info->start)},
                                      {"duration_s", base::ToSeconds(info->duration())},
                                      {"messages", info->messages},
                                      {"content_hash", info->content_hash},
                                      {"scenes", scenes},
                                      {"models", models},
                                      {"warnings", warnings}};
    std::printf("%s\n",
                json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  } else {
    std::printf("%s: %.3f s, %llu messages, content %s\n", info->path.c_str(),
                base::ToSeconds(info->duration()), static_cast<unsigned long long>(info->messages),
                is_whole ? info->content_hash.c_str() : "damaged");
    for (const base::Problem& problem : info->problems) {
      std::fprintf(stderr, "gsv: warning: %s\n", problem.Sentence().c_str());
    }
  }
  return is_whole ? kOk : kInfrastructure;
}

base::Result<std::unique_ptr<gateway::ReplayGateway>> StartGateway(const ReplayArguments& arguments,
                                                                   gateway::ReplayPlayer& player) {
  gateway::GatewayOptions options;
  options.web_root = ShareFolder() / "web";
  const bool is_given = arguments.port >= 0;
  options.port = static_cast<std::uint16_t>(is_given ? arguments.port : 8080);
  auto started = gateway::ReplayGateway::Start(options, player);
  if (started || is_given) return started;
  options.port = 0;  // another program has the usual one
  return gateway::ReplayGateway::Start(options, player);
}

int Replay(const ReplayArguments& arguments, Signals& signals) {
  if (arguments.headless) return CheckReplay(arguments);
  auto player = gateway::ReplayPlayer::Open(arguments.file, arguments.options);
  if (!player) return Refuse(player.error());
  for (const base::Problem& problem : (*player)->problems()) {
    std::fprintf(stderr, "gsv: warning: %s\n", problem.Sentence().c_str());
  }
  auto gateway = StartGateway(arguments, **player);
  if (!gateway) return Complain(gateway.error());
  std::printf("viewer: %s\n", (*gateway)->url().c_str());
  std::fflush(stdout);
  if (!arguments.paused) (void)(*player)->Start();  // it stands at the beginning
  signals.Wait();
  return kOk;
}

void AddReplayCommand(const CommandLine& line) {
  CLI::App* command = line.app.add_subcommand("replay", "Show a recording in the viewer");
  auto arguments = std::make_shared<ReplayArguments>();
  command->add_option("file", arguments->file, "the recording")->required();
  command
      ->add_option("--port", arguments->port,
                   "the viewer's port; 0: any that is free (default: 8080, or any)")
      ->check(CLI::Range(0, 65535));
  command->add_option("--speed", arguments->options.speed, "recorded seconds a second")
      ->check(CLI::Range(0.001, 1000.0))
      ->capture_default_str();
  command->add_flag("--loop", arguments->options.loop, "begin anew at the end");
  command->add_flag("--paused", arguments->paused,
                    "wait at the beginning for somebody to start it");
  CLI::Option* headless =
      command->add_flag("--headless", arguments->headless, "no viewer: read all of it, and check");
  command->add_flag("--json", arguments->json, "one JSON object")->needs(headless);
  command->callback([arguments, line] { line.exit_code = Replay(*arguments, line.signals); });
}

std::shared_ptr<RecordingArguments> AddArguments(CLI::App& command) {
  auto arguments = std::make_shared<RecordingArguments>();
  command.add_option("file", arguments->file, "the recording")->required();
  command.add_flag("--json", arguments->json, "one JSON object");
  return arguments;
}

}  // namespace

void AddRecordingCommands(const CommandLine& line) {
  CLI::App* rec = line.app.add_subcommand("rec", "Look at recordings, mend them");
  rec->require_subcommand(1);

  CLI::App* info = rec->add_subcommand("info", "Print what a recording holds");
  const auto info_arguments = AddArguments(*info);
  info->callback([info_arguments, line] { line.exit_code = Info(*info_arguments); });

  CLI::App* recover =
      rec->add_subcommand("recover", "Make a whole recording of one that was cut off or damaged");
  const auto recover_arguments = AddArguments(*recover);
  recover->add_option("-o,--output", recover_arguments->output, "the file to write")->required();
  recover->callback([recover_arguments, line] { line.exit_code = Recover(*recover_arguments); });

  AddReplayCommand(line);
}

}  // namespace gsv::app
