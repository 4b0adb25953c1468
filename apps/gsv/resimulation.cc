#include "apps/gsv/resimulation.h"

#include <cstdio>
#include <filesystem>

#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include "apps/gsv/exit_code.h"
#include "apps/gsv/recordings.h"
#include "apps/gsv/run.h"
#include "gsv/base/temporary_folder.h"
#include "gsv/hosting/recorded_commands.h"
#include "gsv/messages/cdr.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/time.h"
#include "gsv/recording/decoded_messages.h"
#include "gsv/recording/recording_info.h"

namespace gsv::app {
namespace {

constexpr std::string_view kCommandsTopic = "/gsv/commands";

std::vector<std::string> MotionTopics() { return {"/gsv/poses", "/tf", "/gsv/state_hash"}; }

base::Error NotOfARun(const std::string& file) {
  return {base::ErrorCode::kInvalidArgument,
          "does not say how it was made: only recordings of gsv run can be simulated again", file};
}

// How the recorded run was called.
struct RecordedCall {
  std::vector<std::string> arguments;  // without the program and "run"
  std::string folder;                  // that relative paths start from
};

base::Result<RecordedCall> CallOf(const recording::RecordingInfo& info) {
  for (const recording::MetadataRecord& record : info.metadata) {
    const auto arguments = record.values.find(std::string(kArgumentsKey));
    const auto folder = record.values.find(std::string(kFolderKey));
    if (arguments == record.values.end() || folder == record.values.end()) continue;
    const auto json = nlohmann::json::parse(arguments->second, nullptr, false);
    if (!json.is_array() || json.size() < 2 || json[1] != "run") break;
    RecordedCall call;
    for (std::size_t i = 2; i < json.size(); ++i) {
      if (!json[i].is_string()) return base::Fail(NotOfARun(info.path));
      call.arguments.push_back(json[i].get<std::string>());
    }
    call.folder = folder->second;
    return call;
  }
  return base::Fail(NotOfARun(info.path));
}

// The same run, but for what does not bear on its course.
base::Result<RunOptions> OptionsOf(const RecordedCall& call, const std::string& file) {
  CLI::App app;
  RunArguments arguments;
  AddRunOptions(app, arguments);
  try {
    app.parse(std::vector<std::string>(call.arguments.rbegin(), call.arguments.rend()));
  } catch (const CLI::ParseError& error) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        std::string("was made by a command that this version does not know: ") + error.what(),
        file);
  }
  arguments.broker.clear();
  arguments.lockstep = true;
  arguments.headless = true;
  arguments.open = false;
  arguments.json = false;
  return Understand(arguments);
}

base::Result<hosting::TimedCommand> CommandOf(const messages::gsv_msgs::Command& message) {
  const hosting::TimedCommand command{
      messages::ToSimTime(message.stamp),
      {message.linear_m_s, message.lateral_m_s, message.angular_rad_s}};
  if (world::IsFinite(command.command)) return command;
  return base::Fail(base::ErrorCode::kCorrupt, "a recorded command is not finite",
                    std::string(kCommandsTopic) + " of " + message.robot);
}

// Has every robot do what it did then.
base::Status UseRecordedCommands(const recording::McapReader& reader, RunOptions& run) {
  using messages::gsv_msgs::Command;
  const recording::Summary& summary = reader.summary();
  auto commands = std::make_shared<std::map<std::string, hosting::TimedCommands>>();
  recording::MessageCursor cursor = reader.Messages();
  for (;;) {
    const auto record = cursor.Next();
    if (!record) return base::Fail(record.error());
    if (!*record) break;
    const auto channel = summary.channels.find((*record)->channel_id);
    if (channel == summary.channels.end() || channel->second.topic != kCommandsTopic) continue;
    const auto message = messages::Decode<Command>((*record)->data);
    if (!message) return base::Fail(message.error());
    const auto command = CommandOf(*message);
    if (!command) return base::Fail(command.error());
    (*commands)[message->robot].push_back(*command);
  }
  run.make_behaviour = [commands](const std::string& robot, const std::string& behaviour) {
    return std::make_shared<hosting::RecordedCommands>(behaviour, (*commands)[robot]);
  };
  return {};
}

void Print(const std::optional<recording::Difference>& difference,
           const recording::RecordingInfo& info, bool json) {
  if (json) {
    nlohmann::ordered_json report{{"equal", !difference.has_value()},
                                  {"duration_s", base::ToSeconds(info.duration())},
                                  {"messages", info.messages}};
    if (difference) report["first_difference"] = ToJson(*difference);
    std::puts(report.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  } else if (difference) {
    std::printf("simulated again, it differs: %s\n", difference->Sentence().c_str());
  } else {
    std::printf("simulated again, it is the same: %llu messages, %.3f s\n",
                static_cast<unsigned long long>(info.messages), base::ToSeconds(info.duration()));
  }
}

}  // namespace

base::Result<int> Resimulate(const ResimulationOptions& options, Signals& signals) {
  const auto info = recording::ReadInfo(options.file);
  if (!info) return base::Fail(info.error());
  const auto call = CallOf(*info);
  if (!call) return base::Fail(call.error());
  const auto recorded = recording::McapReader::Open(options.file);
  if (!recorded) return base::Fail(recorded.error());
  auto folder = base::TemporaryFolder::Make("gsv-again");
  if (!folder) return base::Fail(folder.error());

  // Paths of the recorded command start from the folder in which it was given.
  std::error_code error;
  std::filesystem::current_path(call->folder, error);
  if (error) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "the folder in which it was recorded cannot be entered: " + error.message(),
                      call->folder);
  }
  auto run = OptionsOf(*call, options.file);
  if (!run) return base::Fail(run.error());
  run->runtime.broker = options.broker;
  run->scenario.expect.clear();  // it was judged then
  run->record = (folder->path() / "again.mcap").string();
  run->specification.duration = info->end;
  if (options.commands) {
    if (auto ok = UseRecordedCommands(**recorded, *run); !ok) return base::Fail(ok.error());
  }
  const auto exit_code = Run(*run, signals, true);
  if (!exit_code || *exit_code != kOk) return exit_code;

  const auto again = recording::McapReader::Open(run->record);
  if (!again) return base::Fail(again.error());
  const auto difference = recording::FirstDifference(
      **recorded, **again, options.commands ? MotionTopics() : std::vector<std::string>());
  if (!difference) return base::Fail(difference.error());
  Print(*difference, *info, options.json);
  return *difference ? kAssertionFailed : kOk;
}

}  // namespace gsv::app
