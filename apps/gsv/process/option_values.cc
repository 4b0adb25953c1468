#include "apps/gsv/process/option_values.h"

#include <algorithm>
#include <utility>

#include "gsv/base/spelling.h"

namespace gsv::app {

void TakeOneValuePerOption(CLI::App& command) {
  for (CLI::Option* option : command.get_options()) {
    if (option->nonpositional()) option->allow_extra_args(false);
  }
  for (CLI::App* subcommand : command.get_subcommands({})) TakeOneValuePerOption(*subcommand);
}

CLI::Validator OneOf(std::vector<std::string> words) {
  std::string description = "{";
  std::string listed;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) {
      description += ',';
      listed += i + 1 < words.size() ? ", " : " or ";
    }
    description += words[i];
    listed += words[i];
  }
  const auto check = [words = std::move(words), listed](std::string& value) -> std::string {
    if (std::find(words.begin(), words.end(), value) != words.end()) return {};
    return "expected " + listed + ", found " + value + base::DidYouMean(value, words);
  };
  return CLI::Validator(check, description + "}");
}

}  // namespace gsv::app
