#include "apps/gsv/commands/gsv_command.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/help_formatter.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/process/program_end.h"
#include "apps/gsv/process/standard_output.h"
#include "gsv/base/log.h"
#include "gsv/base/spelling.h"

namespace gsv::app {
namespace {

constexpr const char* kDefaultGroup = "Subcommands";  // CLI11's group of a new command

struct LogArguments {
  std::string level, format;
  std::size_t lines = base::LogOptions{}.lines_per_second;
};

template <typename Parse>
CLI::Validator ReadableBy(Parse parse) {
  return CLI::Validator(
      [parse](const std::string& text) {
        const auto parsed = parse(text);
        return parsed ? std::string() : parsed.error().Sentence();
      },
      "");
}

void AddLogOptions(CLI::App& app, LogArguments& log) {
  app.add_option("--log-level", log.level, "lowest level to log on stderr (default: warning)")
      ->type_name("trace|debug|info|warning|error|off")
      ->check(ReadableBy(&base::ParseLogLevel))
      ->envname("GSV_LOG_LEVEL");
  app.add_option("--log-format", log.format, "format of log lines (default: text)")
      ->type_name("text|json")
      ->check(ReadableBy(&base::ParseLogFormat))
      ->envname("GSV_LOG_FORMAT");
  app.add_option(
         "--log-rate", log.lines,
         "maximum average of log lines per second; lines above it are suppressed and counted")
      ->type_name("N")
      ->check(Between(1, 1'000'000))
      ->capture_default_str();
}

struct CorbaArguments {
  std::string certificate, key, authority;
  bool is_insecure = false;
};

void AddCorbaOptions(CLI::App& app, CorbaArguments& corba) {
  app.add_option("--corba-certificate", corba.certificate,
                 "certificate (PEM) of this program; with it, CORBA uses TLS\n"
                 "Both programs of a connection need a certificate from the same authority. `gsv "
                 "certificates make` makes one.")
      ->type_name("FILE")
      ->envname("GSV_CORBA_CERTIFICATE");
  app.add_option("--corba-key", corba.key, "private key (default: NAME-key.pem beside NAME.pem)")
      ->type_name("FILE")
      ->envname("GSV_CORBA_KEY");
  app.add_option("--corba-authority", corba.authority,
                 "certificate authority to trust (default: ca.pem beside NAME.pem)")
      ->type_name("FILE")
      ->envname("GSV_CORBA_AUTHORITY");
  app.add_flag("--insecure-corba", corba.is_insecure,
               "accept CORBA calls without certificates\n"
               "Everyone who can reach this machine may then control gsv. GSV_INSECURE_CORBA=1 has "
               "the same effect.");
}

// Sets environment variables for orb::PrepareAccess(), and for programs that this process starts.
void UseCorbaOptions(const CorbaArguments& corba) {
  const auto set = [](const char* name, const std::string& path) {
    if (!path.empty()) setenv(name, std::filesystem::absolute(path).c_str(), 1);
  };
  set("GSV_CORBA_CERTIFICATE", corba.certificate);
  set("GSV_CORBA_KEY", corba.key);
  set("GSV_CORBA_AUTHORITY", corba.authority);
  if (corba.is_insecure) setenv("GSV_INSECURE_CORBA", "1", 1);
}

// Starts logging. Sets environment variables, so that programs that this process starts log in the
// same way as this process.
void StartLog(const LogArguments& log, bool verbose) {
  if (!log.level.empty()) setenv("GSV_LOG_LEVEL", log.level.c_str(), 1);
  if (!log.format.empty()) setenv("GSV_LOG_FORMAT", log.format.c_str(), 1);
  base::LogOptions options = base::LogOptionsFromEnvironment(spdlog::level::warn);
  options.lines_per_second = log.lines;
  if (verbose && log.level.empty()) options.level = spdlog::level::debug;
  base::InitLogging(options);
}

// Returns the error message about the first unknown option or, without an unknown option, about the
// first unknown word. `words` are the words that the command does not know, at least one word.
std::string UnknownWord(const CLI::App& command, const std::vector<std::string>& words) {
  const auto option = std::find_if(words.begin(), words.end(),
                                   [](const auto& word) { return word.starts_with('-'); });
  std::vector<std::string> known;
  if (option != words.end()) {
    for (const CLI::Option* each : command.get_options()) {
      for (const std::string& name : each->get_lnames()) known.push_back("--" + name);
    }
    const std::string name = option->substr(0, option->find('='));
    return "there is no option " + name + base::DidYouMean(name, known);
  }
  for (const CLI::App* each : command.get_subcommands([](const CLI::App*) { return true; })) {
    if (!each->get_group().empty()) known.push_back(each->get_name());
  }
  if (known.empty()) return "unexpected argument " + words.front();
  return "there is no command " + words.front() + base::DidYouMean(words.front(), known);
}

// Returns the sentence for a missing argument, option or value. `what` is CLI11's sentence, such as
// "topic is required", "--seed: 1 required N missing" or "--start: At least 3 required but received
// 1". Other sentences are returned unchanged.
std::string MissingSentence(const CLI::App& command, const std::string& what) {
  const std::string word = what.substr(0, what.find(' ')), rest = what.substr(word.size());
  const auto name_and_value = [&](const std::string& name) {
    const CLI::Option* const option = command.get_option_no_throw(name);
    return option == nullptr ? std::string() : " " + ValueNameOf(*option);
  };
  if (rest == " is required") {
    return word.starts_with('-') ? "missing option " + word + name_and_value(word)
                                 : "missing argument " + word;
  }
  if (!word.ends_with(':')) return what;
  const std::string name = word.substr(0, word.size() - 1);
  if (rest.find(" required ") != std::string::npos && rest.ends_with(" missing")) {
    return name + ": missing value" + name_and_value(name);
  }
  unsigned expected = 0, found = 0;
  if (std::sscanf(rest.c_str(), " At least %u required but received %u", &expected, &found) == 2) {
    return fmt::format("{}: expected {} values, found {}", name, expected, found);
  }
  return what;
}

// Returns the error message: one sentence, and a hint at --help. If the user typed an unknown
// command, CLI11 reports a missing command, so this function finds the unknown word.
std::string UsageSentence(const CLI::App* app, const CLI::Error& error) {
  const CLI::App* typed = app;  // the command that the user typed
  std::string words = app->get_name();
  while (!typed->get_subcommands().empty()) {
    typed = typed->get_subcommands().front();
    words += " " + typed->get_name();
  }
  std::string what = MissingSentence(*typed, error.what());
  const bool is_required = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::RequiredError);
  if (is_required && typed->get_require_subcommand_min() > 0) {
    const std::vector<std::string> unknown = typed->remaining();
    what = unknown.empty() ? "a command is missing" : UnknownWord(*typed, unknown);
  } else if (!typed->remaining().empty()) {
    what = UnknownWord(*typed, typed->remaining());
  } else if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExcludesError)) {
    const std::string word = " excludes ";
    if (const std::size_t at = what.find(word); at != std::string::npos) {
      what.replace(at, word.size(), " and ");
      what += " cannot be used together";
    }
  } else if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ConversionError)) {
    // CLI11 writes "Could not convert: --option = value". Only options for numbers have this error,
    // so the new sentence says that a number was expected.
    const std::string begin = "Could not convert: ", middle = " = ";
    const std::size_t at = what.find(middle);
    if (what.starts_with(begin) && at != std::string::npos) {
      what.replace(at, middle.size(), ": expected a number, found ");
      what.erase(0, begin.size());
    }
  }
  return "gsv: " + what + (what.ends_with('?') ? " See " : ". See ") + words + " --help\n";
}

// Commands that are added together. A command in `names` gets the help group, unless it is hidden.
struct CommandFamily {
  const char* help_group;  // null if the commands have set it themselves
  std::vector<std::string_view> names;
  std::vector<void (*)(const CommandLine&)> add;
};

// Returns all families, in the order of the help text.
const std::vector<CommandFamily>& Families() {
  static constexpr const char* kRun = "Commands to run simulations";
  static constexpr const char* kRecordings = "Commands for recordings";
  static constexpr const char* kFiles = "Commands for files";
  static constexpr const char* kLogs = "Commands for logs of real robots";
  static constexpr const char* kMachine = "Commands for this machine";
  static constexpr const char* kBrokers = "Commands for brokers";
  static const std::vector<CommandFamily> families{
      {kRun, {"run", "run-server"}, {&AddRunCommand}},
      {kRun, {"serve"}, {&AddServeCommand}},
      {kRun, {"view"}, {&AddViewCommand}},
      {kRun, {"test"}, {&AddTestCommand}},
      {kRun, {"campaign"}, {&AddCampaignCommand}},
      // and a command for each row of simulation::Commands()
      {nullptr, {"ps", "output", "pause", "resume", "step", "stop"}, {&AddControlCommands}},
      {kRecordings, {"rec", "replay"}, {&AddRecordingCommands, &AddRecordCommands}},
      {kRecordings, {"snapshot"}, {&AddSnapshotCommand}},
      {kRecordings, {"film"}, {&AddFilmCommand}},
      {kFiles,
       {"world", "model"},
       {&AddCheckCommands, &AddConvertCommand, &AddDrawCommand, &AddMapCommands, &AddSaveCommand}},
      {kMachine, {"doctor"}, {&AddDoctorCommand}},
      {kFiles, {"list"}, {&AddListCommand}},
      {kMachine, {"completion"}, {&AddCompletionCommand}},
      {kLogs, {"compare", "fit"}, {&AddCompareCommands}},
      {kBrokers, {"broker", "offers", "types", "links"}, {&AddBrokerCommands}},
      {"Commands for ROS 2", {"ros2"}, {&AddRos2Commands}},
      {kMachine, {"bench"}, {&AddBenchCommands}},
      {kMachine, {"certificates"}, {&AddCertificatesCommand}}};
  return families;
}

// Adds the commands that the arguments can name. If the first argument is a command, that is its
// family, and `gsv --version` names no command: to describe all commands to CLI11 would take a fifth
// of the time of a start. `gsv completion` and help texts need all commands.
void AddCommands(const CommandLine& line, int argc, char** argv) {
  const std::string_view first = argc > 1 ? argv[1] : "";
  if (argc == 2 && first == "--version") return;
  const auto has_first = [&](const CommandFamily& family) {
    return std::find(family.names.begin(), family.names.end(), first) != family.names.end();
  };
  const std::vector<CommandFamily>& all = Families();
  const bool needs_all = first == "completion" || std::none_of(all.begin(), all.end(), has_first);
  for (const CommandFamily& family : all) {
    if (!needs_all && !has_first(family)) continue;
    for (const auto add : family.add) add(line);
    for (const std::string_view name : family.names) {
      CLI::App* const command = line.app.get_subcommand(std::string(name));
      if (command->get_group() == kDefaultGroup) command->group(family.help_group);
    }
  }
}

// Returns the arguments in reverse order, as CLI11 requires. Converts `gsv help run` to
// `gsv run --help`. If the word after `help` is no command, "--help" is not added, so that CLI11
// reports the unknown command.
std::vector<std::string> WordsOf(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    const auto is_named = [&](const CLI::App* command) {
      return command->get_name() == words.front();
    };
    if (words.empty() || !app.get_subcommands(is_named).empty()) {
      words.emplace_back("--help");
    }
  }
  std::reverse(words.begin(), words.end());
  return words;
}

}  // namespace

int RunGsv(int argc, char** argv) {
  Signals signals;
  int exit_code = kOk;
  CLI::App app(
      "GSV simulates robots in 3D worlds. Behaviours are separate programs. GSV finds "
      "them\nthrough a broker.",
      "gsv");
  UseHelpFormatter(app);
  app.set_version_flag("--version", "gsv " GSV_VERSION, "print the version");
  app.require_subcommand(1);
  app.failure_message(UsageSentence);
  bool verbose = false;
  app.add_flag("-v,--verbose", verbose, "log more, as --log-level debug");
  LogArguments log;
  AddLogOptions(app, log);
  CorbaArguments corba;
  AddCorbaOptions(app, corba);
  app.parse_complete_callback([&] {
    StartLog(log, verbose);
    UseCorbaOptions(corba);
  });
  const CommandLine line{app, signals, exit_code};
  AddCommands(line, argc, argv);
  TakeOneValuePerOption(app);
  try {
    app.parse(WordsOf(app, argc, argv));
  } catch (const CLI::ParseError& error) {
    return EndOutput(stdout, app.exit(error) == 0 ? kOk : kUsage);
  } catch (const std::exception& exception) {
    return PrintError({base::ErrorCode::kUnavailable, exception.what(), "unexpected"});
  }
  return EndProgram(exit_code);
}

}  // namespace gsv::app
