#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands.h"
#include "apps/gsv/exit_code.h"
#include "gsv/recording/recording_info.h"
#include "gsv/recording/recover.h"

namespace gsv::app {
namespace {

struct RecordingArguments {
  std::string file, output;
  bool json = false;
};

int Info(const RecordingArguments& arguments) {
  const auto info = recording::ReadInfo(arguments.file);
  if (!info) return Complain(info.error());
  const std::string text =
      arguments.json ? recording::ToJson(*info) + "\n" : recording::ToText(*info);
  std::fputs(text.c_str(), stdout);
  return kOk;
}

int Recover(const RecordingArguments& arguments) {
  const auto recovery = recording::Recover(arguments.file, arguments.output);
  if (!recovery) return Complain(recovery.error());
  const std::string text =
      arguments.json ? recording::ToJson(*recovery) + "\n" : recording::ToText(*recovery);
  std::fputs(text.c_str(), stdout);
  return kOk;
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
}

}  // namespace gsv::app
