#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include <nlohmann/json.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/commands/recording_list_command.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/running/browser.h"
#include "apps/gsv/running/resimulation.h"
#include "apps/gsv/running/video_export.h"
#include "apps/gsv/serving/ros2_access.h"
#include "apps/gsv/serving/viewer_options.h"
#include "gsv/base/counted.h"
#include "gsv/base/spelling.h"
#include "gsv/gateway/http/target.h"
#include "gsv/recording/attachments/scene_attachments.h"
#include "gsv/recording/reading/decoded_messages.h"
#include "gsv/recording/reading/recording_info.h"
#include "gsv/recording/reading/recover.h"
#include "gsv/recording/recording_difference.h"

namespace gsv::app {
namespace {

struct RecordingArguments {
  std::string file, other, output;
  std::vector<std::string> topics;
  double from = -1e9, to = 1e9;  // in s
  double frames_a_second = 25;
  bool json = false, video = false;

  recording::Selection Selection() const {
    return {topics, base::FromSeconds(from), base::FromSeconds(to)};
  }
};

// Prints the error and returns the exit code. If the recording is missing, the exit code is
// kInfrastructure. (PrintError() returns kBadModel in this case.)
int Refuse(const base::Error& error) {
  const int code = PrintError(error);
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

// Rejects a selection that begins after its end, or that names a topic that is not in the
// recording.
base::Status CheckSelection(const RecordingArguments& arguments,
                            const recording::McapReader& reader) {
  if (arguments.from > arguments.to) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "must not be after --to", "--from");
  }
  for (const std::string& topic : arguments.topics) {
    const recording::Selection one{{topic}};
    const auto& channels = reader.summary().channels;
    if (std::any_of(channels.begin(), channels.end(),
                    [&](const auto& each) { return one.Has(each.second.topic); })) {
      continue;
    }
    std::vector<std::string> known;
    for (const auto& [id, channel] : channels) known.push_back(channel.topic);
    return base::Fail(base::ErrorCode::kNotFound,
                      "the recording has no such topic; `gsv rec info` lists its topics" +
                          base::DidYouMean(topic, known),
                      topic);
  }
  return {};
}

void WarnIfEmpty(std::uint64_t messages, const std::string& file) {
  if (messages > 0) return;
  std::fprintf(stderr, "gsv: warning: %s: the selected part has no messages\n", file.c_str());
}

int Filter(const RecordingArguments& arguments) {
  const auto reader = recording::McapReader::Open(arguments.file);
  if (!reader) return Refuse(reader.error());
  if (auto ok = CheckSelection(arguments, **reader); !ok) return Refuse(ok.error());
  const auto filtered = recording::Recover(arguments.file, arguments.output, arguments.Selection());
  if (!filtered) return Refuse(filtered.error());
  WarnIfEmpty(filtered->messages, arguments.file);
  std::fputs((recording::ToJson(*filtered) + "\n").c_str(), stdout);
  return kOk;
}

// Prints one JSON object per line.
int Cat(const RecordingArguments& arguments) {
  const auto reader = recording::McapReader::Open(arguments.file);
  if (!reader) return Refuse(reader.error());
  if (auto ok = CheckSelection(arguments, **reader); !ok) return Refuse(ok.error());
  auto messages = recording::DecodedMessages::Open(**reader, arguments.Selection());
  if (!messages) return Refuse(messages.error());
  std::uint64_t printed = 0;
  for (;;) {
    auto message = messages->Next();
    if (!message) return Refuse(message.error());
    if (!*message) {
      WarnIfEmpty(printed, arguments.file);
      return kOk;
    }
    ++printed;
    const nlohmann::ordered_json line{
        {"time_s", base::ToSeconds((*message)->time)},
        {"topic", (*message)->topic},
        {"type", (*message)->type},
        {"message", recording::WithInfinitiesAsText(std::move((*message)->content))}};
    std::puts(line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    if (std::ferror(stdout) != 0) return kInfrastructure;  // for example, the pipe is closed
  }
}

bool IsRecording(const std::string& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) &&
         recording::McapReader::Open(file).has_value();
}

int Video(const RecordingArguments& arguments, const recording::McapReader& reader) {
  if (arguments.output.empty()) {
    return PrintError({base::ErrorCode::kInvalidArgument,
                       "cannot write the video: no file is given. Use -o NAME.mp4",
                       {}});
  }
  VideoOptions options;
  options.output = arguments.output;
  options.frames_a_second = arguments.frames_a_second;
  const auto frames = ExportVideo(reader, arguments.Selection(), options);
  if (!frames) return Refuse(frames.error());
  std::printf("%s: %s\n", options.output.c_str(), base::Counted(*frames, "frame").c_str());
  return kOk;
}

int Export(const RecordingArguments& arguments) {
  const auto reader = recording::McapReader::Open(arguments.file);
  if (!reader) return Refuse(reader.error());
  if (auto ok = CheckSelection(arguments, **reader); !ok) return Refuse(ok.error());
  if (IsRecording(arguments.output)) {
    return PrintError(
        {base::ErrorCode::kInvalidArgument,
         "is an existing recording and will not be overwritten; choose another output file",
         arguments.output});
  }
  if (arguments.video) return Video(arguments, **reader);
  const auto csv = recording::ToCsv(**reader, arguments.Selection());
  if (!csv) return Refuse(csv.error());
  const bool has_rows = csv->find('\n') + 1 < csv->size();
  WarnIfEmpty(has_rows ? 1 : 0, arguments.file);
  if (arguments.output.empty()) {
    std::fputs(csv->c_str(), stdout);
    return kOk;
  }
  std::ofstream file(arguments.output, std::ios::binary);
  file << *csv << std::flush;
  if (file) return kOk;
  return PrintError({base::ErrorCode::kUnavailable,
                     "cannot write the file; check the folder and the free space",
                     arguments.output});
}

// Extracts an attachment. If several attachments have the name, extracts the last one in the file.
int Extract(const RecordingArguments& arguments) {
  const auto reader = recording::McapReader::Open(arguments.file);
  if (!reader) return Refuse(reader.error());
  const auto& attachments = (*reader)->summary().attachments;
  const auto found = std::find_if(attachments.rbegin(), attachments.rend(),
                                  [&](const auto& each) { return each.name == arguments.other; });
  if (found == attachments.rend()) {
    return Refuse(
        {base::ErrorCode::kNotFound,
         "has no attachment \"" + arguments.other + "\"; `gsv rec info` lists its attachments",
         arguments.file});
  }
  const auto attachment = (*reader)->Read(*found);
  if (!attachment) return Refuse(attachment.error());
  std::FILE* const file =
      arguments.output.empty() ? stdout : std::fopen(arguments.output.c_str(), "wbx");
  const std::string where = arguments.output.empty() ? "stdout" : arguments.output;
  if (file == nullptr) {
    return PrintError({base::ErrorCode::kUnavailable, std::strerror(errno), where});
  }
  const std::size_t written =
      std::fwrite(attachment->data.data(), 1, attachment->data.size(), file);
  const bool is_flushed = (arguments.output.empty() ? std::fflush(file) : std::fclose(file)) == 0;
  if (written == attachment->data.size() && is_flushed) return kOk;
  return PrintError({base::ErrorCode::kUnavailable,
                     "cannot write the whole attachment; check the free space", where});
}

int Diff(const RecordingArguments& arguments) {
  const auto first = recording::McapReader::Open(arguments.file);
  if (!first) return Refuse(first.error());
  const auto second = recording::McapReader::Open(arguments.other);
  if (!second) return Refuse(second.error());
  const auto difference = recording::CompareRecordings(**first, **second);
  if (!difference) return Refuse(difference.error());
  const std::string text =
      arguments.json
          ? difference->Json().dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"
          : difference->Text();
  std::fputs(text.c_str(), stdout);
  return difference->messages ? kAssertionFailed : kOk;
}

struct ReplayArguments {
  std::string file;
  ViewerOptions web;
  Ros2Arguments ros2;
  gateway::ReplayOptions options;
  double at = -1;      // start of the replay, simulated time in s; < 0: the recording's start
  std::string select;  // robot that the viewer selects
  bool headless = false;
  bool paused = false;
  bool open = false;
  bool json = false;
  bool resimulate = false;
  std::string broker;     // the broker's reference, for --resimulate
  bool commands = false;  // whether --resimulate repeats recorded commands
};

// Reads the whole file, message by message, and reports what a replay would show.
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

base::Result<std::unique_ptr<gateway::Gateway>> StartGateway(const ReplayArguments& arguments,
                                                             gateway::ReplayPlayer& player) {
  gateway::GatewayOptions options;
  options.web_root = ShareFolder() / "web";
  options.docs_root = ShareFolder() / "docs";
  std::error_code error;
  // The file exists, because the player has opened it. So canonical() returns a path with a file
  // name.
  const std::filesystem::path file = std::filesystem::canonical(arguments.file, error);
  options.recordings_folder = file.parent_path();
  options.only_recording = file.filename();
  return StartViewer(arguments.web, options, [&](const auto& there) {
    return gateway::Gateway::StartReplay(there, player);
  });
}

// The part of the viewer's address that selects an instant and a robot.
std::string AtInstant(const ReplayArguments& arguments) {
  if (arguments.at < 0) return {};
  char text[48];
  std::snprintf(text, sizeof text, "#t=%g", arguments.at);
  return text + (arguments.select.empty() ? "" : "&select=" + gateway::Escape(arguments.select));
}

int Replay(const ReplayArguments& arguments, Signals& signals) {
  if (arguments.json && !arguments.headless && !arguments.resimulate) {
    return PrintError({base::ErrorCode::kInvalidArgument,
                       "has an effect only with --headless or --resimulate", "--json"});
  }
  auto ros2 = ParseArguments(arguments.ros2);
  if (!ros2) return PrintError(ros2.error());
  if (*ros2 && (arguments.headless || arguments.resimulate)) {
    return PrintError({base::ErrorCode::kInvalidArgument,
                       "has no effect with --headless or --resimulate, because nothing is played",
                       "--ros2"});
  }
  if (arguments.resimulate) {
    const auto end =
        Resimulate({arguments.file, arguments.broker, arguments.commands, arguments.json}, signals);
    return end ? *end : Refuse(end.error());
  }
  if (arguments.headless) return CheckReplay(arguments);
  auto player = gateway::ReplayPlayer::Open(arguments.file, arguments.options);
  if (!player) return Refuse(player.error());
  for (const base::Problem& problem : (*player)->problems()) {
    std::fprintf(stderr, "gsv: warning: %s\n", problem.Sentence().c_str());
  }
  auto gateway = StartGateway(arguments, **player);
  if (!gateway) return PrintError(gateway.error());
  if (arguments.at >= 0) (*player)->Seek(base::FromSeconds(arguments.at));
  const std::string url = (*gateway)->url() + AtInstant(arguments);
  std::printf("viewer: %s\n", url.c_str());
  std::unique_ptr<Ros2Replay> published;
  if (*ros2) {
    auto started = Ros2Replay::Start(**ros2, arguments.file, [&player = **player] {
      const gateway::ReplayClock clock = player.clock();
      return ros2::RecordingBridge::Position{clock.position(), clock.speed()};
    });
    if (!started) return PrintError(started.error());
    published = *std::move(started);
    std::printf("ros2: %s\n", published->Description().c_str());
  }
  std::fflush(stdout);
  if (arguments.open) OpenBrowser(url);
  if (!arguments.paused) (void)(*player)->Start();  // a new player is paused
  signals.Wait();
  return kOk;
}

void AddReplayCommand(const CommandLine& line) {
  CLI::App* command = line.app.add_subcommand("replay", "Show a recording in the viewer");
  auto arguments = std::make_shared<ReplayArguments>();
  command->add_option("file", arguments->file, "recording: file NAME.mcap or folder NAME")
      ->required();
  AddViewerOptions(*command, arguments->web);
  AddRos2ReplayOptions(*command, arguments->ros2);
  command
      ->add_option("--speed", arguments->options.speed,
                   "recorded seconds per second of wall-clock time")
      ->type_name("F")
      ->check(Between(0.001, 1000.0))
      ->capture_default_str();
  CLI::Option* at =
      command->add_option("--at", arguments->at, "simulated time at which the replay begins")
          ->type_name("SECONDS")
          ->check(Between(0.0, 1e9));
  command
      ->add_option("--select", arguments->select,
                   "robot that is selected when the viewer opens; only with --at")
      ->type_name("ROBOT")
      ->needs(at);
  command->add_flag("--open", arguments->open, "open the viewer in a browser");
  command->add_flag("--loop", arguments->options.loop, "start again at the end");
  command->add_flag("--paused", arguments->paused, "wait until a viewer starts the replay");
  command->add_flag("--headless", arguments->headless,
                    "check the whole recording, without a viewer");
  CLI::Option* resimulate = command->add_flag(
      "--resimulate", arguments->resimulate,
      "run the simulation again and print where the result first differs (exit code 1)\n"
      "The simulation runs in lockstep, without a viewer. Without --commands, it has live "
      "behaviours.");
  command
      ->add_option("--broker", arguments->broker,
                   "broker that offers the behaviours; only with --resimulate")
      ->type_name("ADDRESS")
      ->needs(resimulate);
  command
      ->add_flag("--commands", arguments->commands,
                 "apply the recorded commands instead of behaviours; only with --resimulate\n"
                 "gsv then compares only the motions of the bodies.")
      ->needs(resimulate);
  command->add_flag("--json", arguments->json,
                    "print one JSON object; only with --headless or --resimulate");
  command->callback([arguments, line] { line.exit_code = Replay(*arguments, line.signals); });
}

std::shared_ptr<RecordingArguments> AddArguments(CLI::App& command) {
  auto arguments = std::make_shared<RecordingArguments>();
  command.add_option("file", arguments->file, "recording: file NAME.mcap or folder NAME")
      ->required();
  command.add_flag("--json", arguments->json, "print one JSON object");
  return arguments;
}

}  // namespace

void AddRecordingCommands(const CommandLine& line) {
  CLI::App* rec = line.app.add_subcommand("rec", "Inspect, repair and convert recordings");
  rec->require_subcommand(1);

  AddRecordingListCommand(line, *rec);

  CLI::App* info = rec->add_subcommand("info", "Print the contents of a recording");
  const auto info_arguments = AddArguments(*info);
  info->callback([info_arguments, line] { line.exit_code = Info(*info_arguments); });

  CLI::App* recover =
      rec->add_subcommand("recover", "Repair a recording that is incomplete or damaged");
  const auto recover_arguments = AddArguments(*recover);
  recover->add_option("-o,--output", recover_arguments->output, "file to write")
      ->type_name("FILE")
      ->required();
  recover->callback([recover_arguments, line] { line.exit_code = Recover(*recover_arguments); });

  const auto add_selection = [](CLI::App& command, RecordingArguments& arguments) {
    command
        .add_option("--topic", arguments.topics,
                    "topic to select; a trailing slash selects all topics below it")
        ->type_name("TOPIC");
    command.add_option("--from", arguments.from, "first simulated time to select")
        ->type_name("SECONDS");
    command.add_option("--to", arguments.to, "last simulated time to select")->type_name("SECONDS");
  };
  const auto add = [&](const char* name, const char* what, auto run) {
    CLI::App* command = rec->add_subcommand(name, what);
    auto arguments = std::make_shared<RecordingArguments>();
    command->add_option("file", arguments->file, "recording: file NAME.mcap or folder NAME")
        ->required();
    command->callback([arguments, line, run] { line.exit_code = run(*arguments); });
    return std::pair(command, arguments);
  };
  {
    const auto [command, arguments] = add("cat", "Print messages, one JSON object per line", Cat);
    add_selection(*command, *arguments);
  }
  {
    const auto [command, arguments] =
        add("export", "Write a topic as a table (CSV), or images as a video", Export);
    add_selection(*command, *arguments);
    command->get_option("--topic")->required()->expected(1);
    command
        ->add_option("-o,--output", arguments->output,
                     "file to write (default: stdout; required with --video)")
        ->type_name("FILE");
    CLI::Option* video = command->add_flag("--video", arguments->video,
                                           "write the images of the topic as a video, with ffmpeg");
    command->add_option("--fps", arguments->frames_a_second, "frames per second of the video")
        ->type_name("HZ")
        ->check(Between(0.1, 240.0))
        ->needs(video)
        ->capture_default_str();
  }
  {
    const auto [command, arguments] =
        add("filter", "Write a part of a recording as a new recording", Filter);
    add_selection(*command, *arguments);
    command->add_option("-o,--output", arguments->output, "file to write")
        ->type_name("FILE")
        ->required();
  }
  {
    const auto [command, arguments] =
        add("extract", "Write an attachment, such as scenario.yaml, unchanged", Extract);
    command
        ->add_option("attachment", arguments->other,
                     "name of the attachment, as `gsv rec info` prints it")
        ->required();
    command->add_option("-o,--output", arguments->output, "new file to write (default: stdout)")
        ->type_name("FILE");
  }
  {
    const auto [command, arguments] =
        add("diff", "Print where two recordings first differ; exit code 1 if they do", Diff);
    command->add_option("other", arguments->other, "second recording, to compare with the first")
        ->required();
    command->add_flag("--json", arguments->json, "print one JSON object");
  }

  AddReplayCommand(line);
}

}  // namespace gsv::app
