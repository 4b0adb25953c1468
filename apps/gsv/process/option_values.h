// Validators for the values of command-line options.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace gsv::app {

// Makes each option of the command and of its subcommands take one argument, so that another
// argument may follow it, as in `--drive NAME=diff FILE`. Otherwise CLI11 takes all following words
// as values of an option that may be repeated.
void TakeOneValuePerOption(CLI::App& command);

// Accepts only numbers from `low` to `high`. The error names the range and the value.
CLI::Validator Between(double low, double high);
CLI::Validator Between(int low, int high);
CLI::Validator Between(std::uint64_t low, std::uint64_t high);

// Accepts only these words. The error lists them, and suggests one for a misspelt word.
CLI::Validator OneOf(std::vector<std::string> words);

}  // namespace gsv::app
