#include "apps/gsv/process/help_formatter.h"

#include <algorithm>
#include <sstream>

namespace gsv::app {

std::string ValueNameOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

namespace {

constexpr std::size_t kWidth = 80;
constexpr std::size_t kColumn = 28;         // the column at which descriptions of options begin
constexpr std::size_t kCommandColumn = 16;  // the column for commands
constexpr const char* kUngrouped = "Options";
constexpr char kUnbreakable = '\x01';  // stands for a space without a line break

// Formats one entry: the left column, then the wrapped text.
std::string Entry(const std::string& left, const std::string& text, std::size_t column) {
  std::string entry = "  " + left;
  std::size_t at = entry.size();
  if (at + 2 > column) {
    entry += "\n";
    at = 0;
  }
  entry += std::string(column - at, ' ');
  at = column;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool is_first = at == column;
    if (!is_first && at + 1 + word.size() > kWidth) {
      entry += "\n" + std::string(column, ' ');
      at = column;
    } else if (!is_first) {
      entry += " ";
      ++at;
    }
    entry += word;
    at += word.size();
  }
  std::replace(entry.begin(), entry.end(), kUnbreakable, ' ');
  return entry + "\n";
}

std::string NamesOf(const std::set<CLI::Option*>& options) {
  std::string names;
  for (const CLI::Option* option : options)
    names += (names.empty() ? "" : ", ") + option->get_name();
  return names;
}

// Returns the name of the option's value and the range of a number. CLI11 appends ":" and the
// descriptions of validators to the name of the type.
std::pair<std::string, std::string> TypeAndRange(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::string name = ValueNameOf(option);
  const std::size_t colon = type.find(':');
  if (colon == std::string::npos) return {name, ""};
  std::string range = type.substr(colon + 1);
  const bool is_range = range.find(" in [") != std::string::npos && range.back() == ']';
  if (!is_range) return {name, ""};
  range = range.substr(range.find('[') + 1);
  range.pop_back();
  if (const std::size_t dash = range.find(" - "); dash != std::string::npos) {
    range.replace(dash, 3, " to ");
  }
  return {name, range};
}

// Returns the option's first short name and first long name. A second long name is deprecated, so
// it is not returned.
std::string NamesOf(const CLI::Option& option) {
  if (option.get_positional()) return option.get_name(true);
  const auto& short_names = option.get_snames();
  const auto& long_names = option.get_lnames();
  std::string names = short_names.empty() ? "" : "-" + short_names.front();
  if (!long_names.empty()) names += (names.empty() ? "--" : ", --") + long_names.front();
  return names;
}

std::string LeftOf(const CLI::Option& option) {
  std::string left = NamesOf(option);
  if (option.get_type_size() == 0) return left;  // the option is a flag
  if (!option.get_positional()) left += " " + TypeAndRange(option).first;
  const bool is_many = option.get_expected_max() == CLI::detail::expected_max_vector_size;
  return is_many && !left.ends_with("...") ? left + " ..." : left;
}

std::string TextOf(const CLI::Option& option, bool is_full) {
  const std::string description = option.get_description();
  std::string text = description.substr(0, description.find('\n'));
  std::vector<std::string> notes;
  const bool has_value = option.get_type_size() != 0;
  if (has_value && !option.get_default_str().empty() &&
      text.find("(default:") == std::string::npos) {
    std::string value = option.get_default_str();
    if (value.front() == '[') value = value.substr(1, value.size() - 2);  // the value is a list
    notes.push_back("default: " + value);
  }
  if (option.get_required() && !option.get_positional()) notes.push_back("required");
  if (is_full) {
    if (const auto range = TypeAndRange(option).second; !range.empty()) notes.push_back(range);
    if (!option.get_needs().empty()) notes.push_back("needs " + NamesOf(option.get_needs()));
    if (!option.get_excludes().empty())
      notes.push_back("not with " + NamesOf(option.get_excludes()));
  }
  for (std::size_t i = 0; i < notes.size(); ++i) text += (i == 0 ? " (" : "; ") + notes[i];
  if (!notes.empty()) text += ")";
  if (!option.get_envname().empty())
    text += std::string(" [env:") + kUnbreakable + option.get_envname() + "]";
  if (const auto newline = description.find('\n'); is_full && newline != std::string::npos) {
    text += ". " + description.substr(newline + 1);
  }
  return text;
}

std::string Section(const std::string& title, const std::vector<const CLI::Option*>& options,
                    bool is_full) {
  if (options.empty()) return {};
  std::string section = "\n" + title + ":\n";
  for (const CLI::Option* option : options) {
    section += Entry(LeftOf(*option), TextOf(*option, is_full), kColumn);
  }
  return section;
}

std::string OptionSections(const CLI::App& app, bool is_full) {
  std::string sections = Section("Arguments", app.get_options([](const CLI::Option* option) {
    return option->get_positional() && !option->get_group().empty();
  }),
                                 is_full);
  std::vector<std::string> groups = app.get_groups();
  // Options without a group, such as --help, come last.
  std::stable_partition(groups.begin(), groups.end(),
                        [](const std::string& group) { return group != kUngrouped; });
  for (const std::string& group : groups) {
    if (group.empty()) continue;
    sections += Section(group, app.get_options([&](const CLI::Option* option) {
      return option->get_group() == group && option->nonpositional() &&
             option != app.get_help_all_ptr();
    }),
                        is_full);
  }
  return sections;
}

std::string CommandSections(const CLI::App& app) {
  std::vector<std::string> groups;
  for (const CLI::App* command : app.get_subcommands({})) {
    const std::string& group = command->get_group();
    if (group.empty() || std::find(groups.begin(), groups.end(), group) != groups.end()) continue;
    groups.push_back(group);
  }
  std::string sections;
  for (const std::string& group : groups) {
    sections += "\n" + (group == "Subcommands" ? std::string("Commands") : group) + ":\n";
    for (const CLI::App* command : app.get_subcommands({})) {
      if (command->get_group() != group) continue;
      sections += Entry(command->get_name(), command->get_description(), kCommandColumn);
    }
  }
  return sections;
}

}  // namespace

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
  return make_description(app) + make_usage(app, std::move(name)) + CommandSections(*app) +
         OptionSections(*app, mode == CLI::AppFormatMode::All) +
         (app->get_footer().empty() ? "" : "\n" + make_footer(app));
}

void UseHelpFormatter(CLI::App& app) {
  auto formatter = std::make_shared<HelpFormatter>();
  formatter->label("SUBCOMMAND", "COMMAND");
  app.formatter(formatter);
  app.set_help_flag("-h,--help", "print this help");
  app.set_help_all_flag("--help-all", "print this help with details");
}

}  // namespace gsv::app
