#include "gsv/simulation/commands/command_table.h"

#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "gsv/simulation/commands/argument_reader.h"

namespace gsv::simulation {
namespace {

TEST(CommandTable, NamesAreLowerCaseAndUnique) {
  const std::regex name("[a-z]+(_[a-z]+)*");
  std::set<std::string_view> commands;
  for (const Command& command : Commands()) {
    EXPECT_TRUE(std::regex_match(std::string(command.name), name)) << command.name;
    EXPECT_TRUE(commands.insert(command.name).second) << command.name;
    EXPECT_EQ(FindCommand(command.name), &command);
    EXPECT_FALSE(command.summary.empty());
    EXPECT_NE(command.apply, nullptr);
    std::set<std::string_view> parameters;
    for (const Parameter& parameter : command.parameters) {
      EXPECT_TRUE(std::regex_match(std::string(parameter.name), name)) << parameter.name;
      EXPECT_TRUE(parameters.insert(parameter.name).second) << parameter.name;
    }
  }
  EXPECT_EQ(FindCommand("explode"), nullptr);
}

TEST(CommandTable, DefaultValuesAreWithinRange) {
  for (const Command& command : Commands()) {
    Arguments::Values defaults;
    for (const Parameter& parameter : command.parameters) {
      if (parameter.default_value) {
        defaults.emplace(std::string(parameter.name), *parameter.default_value);
      } else if (parameter.is_required()) {
        defaults.emplace(std::string(parameter.name), parameter.maximum);
      }
    }
    EXPECT_TRUE(ReadArguments(command, defaults)) << command.name;
  }
}

}  // namespace
}  // namespace gsv::simulation
