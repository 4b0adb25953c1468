#include "apps/gsv/commands/recording_list_command.h"

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/process/exit_code.h"
#include "gsv/gateway/recordings/recording_folder.h"

namespace gsv::app {
namespace {

using gateway::recordings::RecordingFolder;
using gateway::recordings::RecordingLine;

struct RecordingListArguments {
  std::string folder = ".";
  bool json = false;
};

std::string LocalTimeText(std::chrono::system_clock::time_point time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm local{};
  localtime_r(&seconds, &local);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}", local.tm_year + 1900, local.tm_mon + 1,
                     local.tm_mday, local.tm_hour, local.tm_min);
}

const char* StateText(const RecordingLine& line) {
  if (line.state == RecordingLine::State::kUnfinished) return "unfinished";
  return line.state == RecordingLine::State::kUnreadable ? "unreadable" : "complete";
}

void PrintLine(const RecordingLine& line) {
  std::string text = fmt::format("{:<32} {}", line.name, LocalTimeText(line.modified));
  if (line.state == RecordingLine::State::kComplete) {
    text += fmt::format("  {:8.1f} s", base::ToSeconds(line.end - line.start));
    if (!line.world.empty()) text += "  " + line.world;
    if (line.robots)
      text += fmt::format(", {} robot{}", *line.robots, *line.robots == 1 ? "" : "s");
    if (!line.verdict.empty()) text += "  " + line.verdict;
    if (!line.sentence.empty()) text += "\n    " + line.sentence;
  } else {
    text += std::string("  ") + StateText(line) + (line.problem.empty() ? "" : ": ") + line.problem;
  }
  std::puts(text.c_str());
}

void PrintLineJson(const RecordingLine& line) {
  nlohmann::ordered_json json{{"name", line.name},
                              {"size_bytes", line.size},
                              {"state", StateText(line)},
                              {"problem", line.problem}};
  if (line.state == RecordingLine::State::kComplete) {
    json["start_s"] = base::ToSeconds(line.start);
    json["duration_s"] = base::ToSeconds(line.end - line.start);
    json["messages"] = line.messages;
    json["world"] = line.world;
    if (line.robots) json["robots"] = *line.robots;
    if (!line.verdict.empty()) json["verdict"] = line.verdict;
    if (!line.sentence.empty()) json["sentence"] = line.sentence;
    if (line.violation_s) json["violation_s"] = *line.violation_s;
  }
  std::puts(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

int ListRecordings(const RecordingListArguments& arguments) {
  std::error_code error;
  if (!std::filesystem::is_directory(arguments.folder, error)) {
    const int code =
        PrintError({base::ErrorCode::kNotFound, "cannot list recordings: there is no such folder",
                    arguments.folder});
    return code == kBadModel ? kInfrastructure : code;
  }
  const RecordingFolder::Listing listing = RecordingFolder(arguments.folder).List();
  for (const RecordingLine& line : listing.lines) {
    arguments.json ? PrintLineJson(line) : PrintLine(line);
  }
  if (listing.left_out > 0) {
    std::fprintf(stderr, "gsv: note: %zu older recordings are left out\n", listing.left_out);
  }
  if (listing.lines.empty() && !arguments.json) {
    std::fprintf(stderr, "gsv: there are no recordings in %s\n", arguments.folder.c_str());
  }
  return kOk;
}

}  // namespace

void AddRecordingListCommand(const CommandLine& line, CLI::App& rec) {
  CLI::App* command =
      rec.add_subcommand("list", "List recordings, with world, robots and verdict, newest first");
  auto arguments = std::make_shared<RecordingListArguments>();
  command
      ->add_option(
          "folder", arguments->folder,
          "folder of recordings (default: current folder)\n"
          "The list includes the recordings of failed tests in the subfolder gsv-failures.")
      ->type_name("FOLDER");
  command->add_flag("--json", arguments->json, "print one JSON object per line");
  command->callback([arguments, line] { line.exit_code = ListRecordings(*arguments); });
}

}  // namespace gsv::app
