#include "apps/gsv/process/option_values.h"

#include <fmt/core.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "gsv/base/spelling.h"

namespace gsv::app {
namespace {

template <typename Number>
CLI::Validator RangeOf(Number low, Number high) {
  const char* const kind = std::is_floating_point_v<Number> ? "a number" : "a whole number";
  const auto check = [=](std::string& text) -> std::string {
    Number value{};
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return {};
    return fmt::format("expected {} from {} to {}, found {}", kind, low, high, text);
  };
  return CLI::Validator(check, CLI::Range(low, high).get_description());
}

}  // namespace

CLI::Validator Between(double low, double high) { return RangeOf(low, high); }
CLI::Validator Between(int low, int high) { return RangeOf(low, high); }
CLI::Validator Between(std::uint64_t low, std::uint64_t high) { return RangeOf(low, high); }

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
