// Sets how many arguments the options of the command line take.
#pragma once

#include <CLI/CLI.hpp>

namespace gsv::app {

// Makes each option of the command and of its subcommands take one argument, so that another
// argument may follow it, as in `--drive NAME=diff FILE`. Otherwise CLI11 takes all following words
// as values of an option that may be repeated.
void TakeOneValuePerOption(CLI::App& command);

}  // namespace gsv::app
