#include "apps/gsv/process/option_values.h"

namespace gsv::app {

void TakeOneValuePerOption(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (option->nonpositional()) option->allow_extra_args(false);
  }
  for (CLI::App* subcommand : command.get_subcommands({})) TakeOneValuePerOption(*subcommand);
}

}  // namespace gsv::app
