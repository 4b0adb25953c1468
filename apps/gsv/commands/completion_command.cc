// `gsv completion`: scripts that let a shell complete commands, options and their values. The
// scripts are made from the table of commands, so that no command is missing.
#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"

namespace gsv::app {
namespace {

struct CompletedOption {
  std::string name;  // "--robot"
  std::string help;  // one line
  bool takes_value = false;
  std::vector<std::string> values;  // the accepted values; empty if the option accepts any value
};

struct CompletedCommand {
  std::string path;  // the command's words, such as "rec info"; empty for gsv itself
  std::vector<std::pair<std::string, std::string>>
      commands;  // the names and the help texts of its subcommands
  std::vector<CompletedOption> options;
};

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

// Returns the values of an option whose type name lists them, such as "jpeg|png".
std::vector<std::string> ValuesIn(const std::string& with_checks) {
  // CLI11 appends the checks of the option, as in "jpeg|png:{jpeg,png}".
  const std::string type_name = with_checks.substr(0, with_checks.find(":{"));
  const bool is_list = type_name.find('|') != std::string::npos &&
                       type_name.find_first_of("[]=<, ") == std::string::npos;
  if (!is_list) return {};
  std::vector<std::string> values;
  std::size_t begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
    end = type_name.find('|', begin);
    values.push_back(type_name.substr(begin, end - begin));
  }
  return values;
}

void Collect(const CLI::App& app, const std::string& path, std::vector<CompletedCommand>& found) {
  CompletedCommand command{path, {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      command.options.push_back({"--" + name, FirstLine(option->get_description()),
                                 option->get_items_expected_max() > 0,
                                 ValuesIn(option->get_type_name())});
    }
  }
  std::vector<const CLI::App*> below;
  for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (each->get_group().empty() || each->get_name().empty()) continue;
    command.commands.emplace_back(each->get_name(), FirstLine(each->get_description()));
    below.push_back(each);
  }
  found.push_back(std::move(command));
  for (const CLI::App* each : below) {
    Collect(*each, path.empty() ? each->get_name() : path + " " + each->get_name(), found);
  }
}

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

// Returns the text in single quotes, as bash, zsh and fish read it.
std::string ShellQuoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\"'\"'";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

std::vector<std::string> NamesOf(const CompletedCommand& command) {
  std::vector<std::string> names;
  for (const auto& [name, help] : command.commands) names.push_back(name);
  for (const CompletedOption& option : command.options) names.push_back(option.name);
  return names;
}

// The options whose values the script gets from `gsv list KIND`, each with its KIND.
const std::array<std::pair<const char*, const char*>, 3> kListed{
    {{"--behaviour", "behaviours"}, {"--robot", "models"}, {"--avatar", "models"}}};

// Returns the part of the script that bash and zsh share. This part sets $words_found, the possible
// words, from $so_far (the command so far) and $prev (the previous word).
std::string Cases(const std::vector<CompletedCommand>& commands) {
  std::string text = "  case \"$so_far $prev\" in\n";
  for (const CompletedCommand& command : commands) {
    for (const CompletedOption& option : command.options) {
      if (option.values.empty()) continue;
      text += "    " + ShellQuoted(command.path + " " + option.name) +
              ") words_found=" + ShellQuoted(Joined(option.values)) + "; return ;;\n";
    }
  }
  for (const auto& [option, kind] : kListed) {
    text += std::string("    *' ") + option + "') words_found=\"$(gsv list " + kind +
            " 2>/dev/null)\"; return ;;\n";
  }
  text += "  esac\n  case \"$so_far\" in\n";
  for (const CompletedCommand& command : commands) {
    text += "    " + ShellQuoted(command.path) +
            ") words_found=" + ShellQuoted(Joined(NamesOf(command))) + " ;;\n";
  }
  text += "  esac\n";
  text +=
      "  if [ \"$so_far\" = run ]; then words_found=\"$words_found $(gsv list worlds "
      "2>/dev/null)\"; "
      "fi\n";
  return text;
}

// Returns the part of the bash or zsh script that adds $word to $so_far if this gives a command.
// The script executes this part for each word before the word that is being completed.
std::string PathCases(const std::vector<CompletedCommand>& commands) {
  std::string text = "    case \"$so_far/$word\" in\n";
  for (const CompletedCommand& command : commands) {
    if (command.path.empty()) continue;
    const std::size_t space = command.path.rfind(' ');
    const std::string parent = space == std::string::npos ? "" : command.path.substr(0, space);
    const std::string name = command.path.substr(space == std::string::npos ? 0 : space + 1);
    text += "      " + ShellQuoted(parent + "/" + name) + ") so_far=" + ShellQuoted(command.path) +
            " ;;\n";
  }
  return text + "    esac\n";
}

std::string BashScript(const std::vector<CompletedCommand>& commands) {
  return "# bash completion for gsv, made by `gsv completion bash`\n"
         "_gsv_words() {\n" +
         Cases(commands) +
         "}\n"
         "_gsv() {\n"
         "  local cur=\"${COMP_WORDS[COMP_CWORD]}\" prev=\"${COMP_WORDS[COMP_CWORD-1]}\"\n"
         "  local so_far='' word words_found='' i\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    word=\"${COMP_WORDS[i]}\"\n" +
         PathCases(commands) +
         "  done\n"
         "  _gsv_words\n"
         "  COMPREPLY=($(compgen -W \"$words_found\" -- \"$cur\"))\n"
         "}\n"
         "complete -o default -F _gsv gsv\n";
}

std::string ZshScript(const std::vector<CompletedCommand>& commands) {
  return "#compdef gsv\n"
         "# zsh completion for gsv, made by `gsv completion zsh`\n"
         "_gsv_words() {\n" +
         Cases(commands) +
         "}\n"
         "_gsv() {\n"
         "  local prev=\"${words[CURRENT-1]}\" words_found='' word i\n"
         "  local so_far=''\n"
         "  for ((i = 2; i < CURRENT; ++i)); do\n"
         "    word=\"${words[i]}\"\n" +
         PathCases(commands) +
         "  done\n"
         "  _gsv_words\n"
         "  compadd -- ${=words_found}\n"
         "  _files\n"
         "}\n"
         "_gsv \"$@\"\n";
}

std::string FishScript(const std::vector<CompletedCommand>& commands) {
  std::string text = "# fish completion for gsv, made by `gsv completion fish`\n";
  for (const CompletedCommand& command : commands) {
    std::string condition = "__fish_use_subcommand";
    if (!command.path.empty()) {
      condition.clear();
      std::size_t begin = 0;
      for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
        end = command.path.find(' ', begin);
        condition += (condition.empty() ? "" : "; and ") +
                     ("__fish_seen_subcommand_from " + command.path.substr(begin, end - begin));
      }
    }
    const std::string begin_of_line = "complete -c gsv -n " + ShellQuoted(condition);
    for (const auto& [name, help] : command.commands) {
      text += begin_of_line + " -a " + ShellQuoted(name) + " -d " + ShellQuoted(help) + "\n";
    }
    for (const CompletedOption& option : command.options) {
      text += begin_of_line + " -l " + option.name.substr(2) + " -d " + ShellQuoted(option.help);
      if (option.takes_value) text += " -r";
      if (!option.values.empty()) text += " -a " + ShellQuoted(Joined(option.values));
      text += "\n";
    }
  }
  for (const auto& [option, kind] : kListed) {
    text += std::string("complete -c gsv -n '__fish_seen_subcommand_from run' -l ") + (option + 2) +
            " -r -a '(gsv list " + kind + " 2>/dev/null)'\n";
  }
  return text +
         "complete -c gsv -n '__fish_seen_subcommand_from run' -a '(gsv list worlds "
         "2>/dev/null)'\n";
}

}  // namespace

void AddCompletionCommand(const CommandLine& line) {
  CLI::App* command = line.app.add_subcommand(
      "completion", "Print the script with which a shell completes gsv's commands and options");
  auto shell = std::make_shared<std::string>();
  command
      ->add_option("shell", *shell,
                   "name of the shell\n"
                   "The packages install these scripts. Otherwise: source <(gsv completion "
                   "bash)")
      ->required()
      ->check(OneOf({"bash", "zsh", "fish"}))
      ->type_name("bash|zsh|fish");
  command->callback([shell, line] {
    std::vector<CompletedCommand> commands;
    Collect(line.app, "", commands);
    const std::string text = *shell == "bash"  ? BashScript(commands)
                             : *shell == "zsh" ? ZshScript(commands)
                                               : FishScript(commands);
    std::fputs(text.c_str(), stdout);
    line.exit_code = kOk;
  });
}

}  // namespace gsv::app
