#include "apps/gsv/running/resimulation.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/running/edit_repetition.h"
#include "apps/gsv/running/run.h"
#include "apps/gsv/simulations/recordings.h"
#include "gsv/base/named.h"
#include "gsv/base/sorting.h"
#include "gsv/base/temporary_folder.h"
#include "gsv/hosting/recorded_commands.h"
#include "gsv/messages/cdr.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/time.h"
#include "gsv/presentation/topics.h"
#include "gsv/recording/reading/decoded_messages.h"
#include "gsv/recording/reading/recording_info.h"

namespace gsv::app {
namespace {

namespace topics = presentation::topics;

std::vector<std::string> MotionTopics() {
  return {topics::kPoses.name, topics::kTransforms.name, topics::kStateHash.name};
}

base::Error NotOfARun(const std::string& file) {
  return {base::ErrorCode::kInvalidArgument,
          "does not contain its command: only recordings of `gsv run` can be simulated again",
          file};
}

// The command line of the recorded run.
struct RecordedCall {
  std::vector<std::string> arguments;  // the arguments after the program and "run"
  std::string folder;                  // its working directory, to which relative paths refer
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

// Returns the options with which the recorded run is repeated: the recorded options in lockstep,
// without options that do not affect the run, such as the viewer.
base::Result<RunOptions> OptionsOf(const RecordedCall& call, const std::string& file) {
  CLI::App app;
  RunArguments arguments;
  AddRunOptions(app, arguments);
  TakeOneValuePerOption(app);
  try {
    app.parse(std::vector<std::string>(call.arguments.rbegin(), call.arguments.rend()));
  } catch (const CLI::ParseError& error) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        std::string("was made with a command that this version cannot run: ") + error.what(), file);
  }
  arguments.broker.clear();
  arguments.lockstep = true;
  arguments.headless = true;
  arguments.open = false;
  arguments.json = false;
  return ParseArguments(arguments);
}

// The recorded commands of one robot, and whether it transmits by radio.
struct RecordedRobot {
  hosting::TimedCommands commands;
  bool uses_radio = false;
};
using RecordedRobots = std::map<std::string, RecordedRobot>;

base::Error NotFinite(const char* topic, const std::string& robot) {
  return {base::ErrorCode::kCorrupt, "a recorded command is not finite",
          std::string(topic) + " of " + robot};
}

base::Status Take(const messages::gsv_msgs::Command& message, RecordedRobots& robots) {
  const world::DriveCommand command{message.linear_m_s, message.lateral_m_s, message.angular_rad_s};
  if (!world::IsFinite(command))
    return base::Fail(NotFinite(topics::kCommands.name, message.robot));
  robots[message.robot].commands.push_back({messages::ToSimTime(message.stamp), command});
  return {};
}

base::Status Take(const messages::gsv_msgs::ActuatorCommand& message, RecordedRobots& robots) {
  if (!std::all_of(message.values.begin(), message.values.end(),
                   [](double value) { return std::isfinite(value); })) {
    return base::Fail(NotFinite(topics::kActuators.name, message.robot));
  }
  robots[message.robot].commands.push_back(
      {messages::ToSimTime(message.stamp),
       hosting::RecordedDeviceCommand{message.actuator, {message.values, message.word}}});
  return {};
}

// Adds a radio message to the commands of its sender. A message is sent one step before it is
// received.
base::Status Take(const messages::gsv_msgs::Transmission& message, RecordedRobots& robots) {
  const base::SimTime heard = messages::ToSimTime(message.stamp);
  const auto step = static_cast<std::int64_t>(message.step);
  const base::SimTime sent = step > 0 ? heard - heard / step : base::SimTime(0);
  RecordedRobot& sender = robots[message.sender];
  sender.uses_radio = true;
  sender.commands.push_back(
      {sent,
       hosting::RecordedTransmission{
           message.radio, message.receiver, {message.content.begin(), message.content.end()}}});
  for (const std::string& hearer : message.heard_by) robots[hearer].uses_radio = true;
  return {};
}

template <typename Message>
base::Status TakeFrom(const recording::MessageRecord& record, RecordedRobots& robots) {
  const auto message = messages::Decode<Message>(record.data);
  if (!message) return base::Fail(message.error());
  return Take(*message, robots);
}

// Makes every robot repeat its recorded commands.
base::Status UseRecordedCommands(const recording::McapReader& reader, RunOptions& run) {
  using namespace messages::gsv_msgs;
  const base::Named<decltype(&TakeFrom<Command>)> takers[] = {
      {topics::kCommands.name, TakeFrom<Command>},
      {topics::kActuators.name, TakeFrom<ActuatorCommand>},
      {topics::kRadio.name, TakeFrom<Transmission>}};
  const recording::Summary& summary = reader.summary();
  auto robots = std::make_shared<RecordedRobots>();
  recording::MessageCursor cursor = reader.Messages();
  for (;;) {
    const auto record = cursor.Next();
    if (!record) return base::Fail(record.error());
    if (!*record) break;
    const auto channel = summary.channels.find((*record)->channel_id);
    if (channel == summary.channels.end()) continue;
    const auto* take = base::FindNamed(takers, channel->second.topic);
    if (take == nullptr) continue;
    if (auto ok = (*take)(**record, *robots); !ok) return ok;
  }
  for (auto& [name, acts] : *robots) {
    base::Sort(acts.commands, [](const auto& a, const auto& b) { return a.time < b.time; });
  }
  run.make_behaviour = [robots](const std::string& robot, const std::string& behaviour,
                                base::SimTime from) {
    const RecordedRobot& acts = (*robots)[robot];
    hosting::TimedCommands commands = acts.commands;
    // Removes the commands of an earlier robot with the same name, which was removed before `from`.
    std::erase_if(commands, [&](const hosting::TimedCommand& each) { return each.time < from; });
    return std::make_shared<hosting::RecordedCommands>(behaviour, std::move(commands),
                                                       acts.uses_radio);
  };
  return {};
}

// Returns the topics of both recordings, except the topics about the actions of users.
std::vector<std::string> TopicsWithoutUserActions(const recording::McapReader& first,
                                                  const recording::McapReader& second) {
  std::set<std::string> topics;
  for (const auto* reader : {&first, &second}) {
    for (const auto& [id, channel] : reader->summary().channels) topics.insert(channel.topic);
  }
  for (const std::string_view topic : recording::kUserTopics) topics.erase(std::string(topic));
  return {topics.begin(), topics.end()};
}

// Rejects a run that was not recorded completely, because it cannot be repeated.
base::Status CheckCompleteness(const recording::RecordingInfo& info) {
  const auto refuse = [&](const std::string& reason) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "cannot be simulated again: " + reason + "; replay it instead", info.path);
  };
  if (info.start > base::SimTime(0)) {
    return refuse(fmt::format("it starts at {:.3f} s, in the middle of the run",
                              base::ToSeconds(info.start)));
  }
  for (const recording::MetadataRecord& record : info.metadata) {
    const auto edited = record.values.find("edited");
    if (edited == record.values.end() || edited->second != "true") continue;
    return refuse("a viewer edited the world before the recording started");
  }
  return {};
}

// Returns the number of snapshots and messages that the recorder of a real-time run dropped because
// it was too slow.
std::uint64_t LeftOut(const recording::RecordingInfo& info) {
  std::uint64_t sum = 0;
  for (const recording::MetadataRecord& record : info.metadata) {
    for (const char* key : {"dropped_snapshots", "dropped_messages"}) {
      const auto found = record.values.find(key);
      if (found == record.values.end()) continue;
      std::uint64_t count = 0;
      const std::string& text = found->second;
      (void)std::from_chars(text.data(), text.data() + text.size(), count);
      sum += count;
    }
  }
  return sum;
}

// Returns the simulated time at which the repeated run must end. If `to_end_of_recording` is true,
// this is the end of the recording, otherwise the end of the recording's last step.
base::Result<base::SimTime> EndOf(const recording::RecordingInfo& info,
                                  const recording::McapReader& reader, bool to_end_of_recording) {
  if (to_end_of_recording) return info.end;
  const auto end = recording::EndOfSteps(reader);
  if (!end || *end > base::SimTime(0)) return end;
  return base::Fail(base::ErrorCode::kInvalidArgument, "cannot be simulated again: it has no steps",
                    info.path);
}

void Print(const std::optional<recording::Difference>& difference,
           const recording::RecordingInfo& info, bool json) {
  const std::uint64_t left_out = LeftOut(info);
  if (json) {
    nlohmann::ordered_json report{{"equal", !difference.has_value()},
                                  {"duration_s", base::ToSeconds(info.duration())},
                                  {"messages", info.messages},
                                  {"left_out", left_out}};
    if (difference) report["first_difference"] = ToJson(*difference);
    std::puts(report.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  } else if (difference) {
    std::printf("the new run differs: %s\n", difference->Sentence().c_str());
  } else {
    std::printf("the new run is equal: %llu messages, %.3f s\n",
                static_cast<unsigned long long>(info.messages), base::ToSeconds(info.duration()));
  }
  if (json || left_out == 0) return;
  std::printf(
      "the recording has gaps: the recorder was too slow and left out %llu snapshots or messages. "
      "These were not compared, and missing commands were not applied\n",
      static_cast<unsigned long long>(left_out));
}

}  // namespace

base::Result<int> Resimulate(const ResimulationOptions& options, Signals& signals) {
  const auto info = recording::ReadInfo(options.file);
  if (!info) return base::Fail(info.error());
  const auto call = CallOf(*info);
  if (!call) return base::Fail(call.error());
  const auto recorded = recording::McapReader::Open(options.file);
  if (!recorded) return base::Fail(recorded.error());
  if (auto ok = CheckCompleteness(*info); !ok) return base::Fail(ok.error());
  auto actions = ReadUserActions(**recorded, options.file, options.commands);
  if (!actions) return base::Fail(actions.error());
  auto folder = base::TemporaryFolder::Make("gsv-again");
  if (!folder) return base::Fail(folder.error());

  // Paths of the recorded command are relative to its working directory.
  std::error_code error;
  std::filesystem::current_path(call->folder, error);
  if (error) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "cannot open the folder in which it was recorded: " + error.message(),
                      call->folder);
  }
  auto run = OptionsOf(*call, options.file);
  if (!run) return base::Fail(run.error());
  run->runtime.broker = options.broker;
  // If the recorded events include verdicts, the repeated run must evaluate the expectations again,
  // so that it has the same events. Otherwise, they need not be evaluated again.
  if (!actions->has_verdicts) run->scenario.expect.clear();
  run->record = (folder->path() / "again.mcap").string();
  const bool had_user_actions = actions->was_interrupted || !actions->edits.empty();
  const auto end = EndOf(*info, **recorded, !options.commands && !had_user_actions);
  if (!end) return base::Fail(end.error());
  run->specification.duration = *end;
  run->edits = std::move(actions->edits);
  if (options.commands) {
    if (auto ok = UseRecordedCommands(**recorded, *run); !ok) return base::Fail(ok.error());
  }
  const auto exit_code = Run(*run, signals, true);
  if (!exit_code || *exit_code != kOk) return exit_code;

  const auto again = recording::McapReader::Open(run->record);
  if (!again) return base::Fail(again.error());
  std::vector<std::string> topics;  // empty for all topics
  if (options.commands) {
    topics = MotionTopics();
  } else if (had_user_actions) {
    topics = TopicsWithoutUserActions(**recorded, **again);
  }
  const auto gaps = LeftOut(*info) > 0 ? recording::Gaps::kInFirst : recording::Gaps::kNone;
  const auto difference = recording::FirstDifference(**recorded, **again, topics, gaps);
  if (!difference) return base::Fail(difference.error());
  Print(*difference, *info, options.json);
  return *difference ? kAssertionFailed : kOk;
}

}  // namespace gsv::app
