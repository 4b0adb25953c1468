// The layout of `--help`: 80 columns, one line per option if it fits, options in groups.
//
//   --port PORT               port of the viewer (default: 8080) [env: GSV_PORT]
//
// The description of an option is one short line. Further sentences for the manual page may follow
// after a newline. `--help-all` prints these sentences too, and the ranges of values, and the
// options that an option needs or excludes. tools/make_man_pages and tools/make_completion read
// this output.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace gsv::app {

// Returns the name of an option's value as the help prints it, such as FILE.
std::string ValueNameOf(const CLI::Option& option);

class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
};

// Sets the formatter, -h/--help and the hidden --help-all. Subcommands that are added later inherit
// them.
void UseHelpFormatter(CLI::App& app);

}  // namespace gsv::app
