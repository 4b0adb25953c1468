#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands/broker_listing_commands.h"
#include "apps/gsv/commands/commands.h"
#include "apps/gsv/process/option_values.h"
#include "gsv/broker/broker_command.h"

namespace gsv::app {
namespace {

constexpr double kMaxSeconds = 1e6;

std::chrono::milliseconds Milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000));
}

// Returns the default of --data. Only a broker with a fixed port has a default, because clients
// cannot find a broker again on a port that the system chose. Empty if there is no folder for the
// file.
std::string DefaultDataFile(int port) {
  const char* data = std::getenv("XDG_DATA_HOME");
  const char* home = std::getenv("HOME");
  std::filesystem::path folder;
  if (data != nullptr && *data == '/') {
    folder = data;
  } else if (home != nullptr && *home == '/') {
    folder = std::filesystem::path(home) / ".local/share";
  } else {
    return {};
  }
  folder /= "gsv";
  std::error_code ignored;  // if the folder cannot be created, opening the file reports an error
  std::filesystem::create_directories(folder, ignored);
  return folder / ("broker-" + std::to_string(port) + ".db");
}

void AddBrokerCommand(const CommandLine& line) {
  struct Arguments {
    broker::BrokerCommand command;
    int port = 0;
    std::string file;
    bool memory = false;
    double liveness_period_s = 60;
    double liveness_max_silence_s = 600;
  };
  CLI::App* command = line.app.add_subcommand("broker", "Run a broker (OMG Trading Service)");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("--port", arguments->port, "port to listen on; 0: any free port")
      ->check(Between(0, 65535))
      ->type_name("PORT")
      ->capture_default_str();
  command->add_option("--listen", arguments->command.broker.host, "address to listen on")
      ->type_name("ADDRESS")
      ->capture_default_str();
  CLI::Option* file =
      command
          ->add_option("--data", arguments->file,
                       "file that keeps offers and service types (default: broker-PORT.db)\n"
                       "The default is in the folder gsv of $XDG_DATA_HOME (~/.local/share). "
                       "With --port 0, there is no default file.")
          ->type_name("FILE");
  command->add_flag("--memory", arguments->memory, "keep offers and service types in memory only")
      ->excludes(file);
  command
      ->add_option("--liveness-period", arguments->liveness_period_s,
                   "time between two checks that offered services respond; 0: no checks\n"
                   "The offer of a service that ended is usually visible for at most two periods.")
      ->check(Between(0.0, kMaxSeconds))
      ->type_name("SECONDS")
      ->capture_default_str();
  command
      ->add_option("--liveness-patience", arguments->liveness_max_silence_s,
                   "time without a response after which the offers of a service are removed")
      ->check(Between(0.0, kMaxSeconds))
      ->type_name("SECONDS")
      ->capture_default_str();
  command
      ->add_option("--exit-with-parent", arguments->command.parent,
                   "end the broker when the process with this PID ends")
      ->group("");
  command->callback([arguments, line] {
    arguments->command.broker.port = static_cast<std::uint16_t>(arguments->port);
    std::string& kept = arguments->command.broker.data_file;
    if (!arguments->memory) kept = arguments->file;
    if (!arguments->memory && kept.empty() && arguments->port != 0) {
      kept = DefaultDataFile(arguments->port);
    }
    arguments->command.broker.liveness.period = Milliseconds(arguments->liveness_period_s);
    arguments->command.broker.liveness.max_silence =
        Milliseconds(arguments->liveness_max_silence_s);
    line.exit_code = broker::BrokerMain(arguments->command);
  });
}

}  // namespace

void AddBrokerCommands(const CommandLine& line) {
  AddBrokerCommand(line);
  AddOffersCommand(line);
  AddTypesCommand(line);
  AddLinksCommand(line);
}

}  // namespace gsv::app
