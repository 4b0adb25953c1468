#include "gsv/simulation/commands/command_table.h"

#include <algorithm>

#include "gsv/simulation/simulation.h"

namespace gsv::simulation {

std::span<const Command> Commands() {
  using enum ParameterType;
  static const std::vector<Command> kCommands{
      {"start",
       "Start a simulation",
       {},
       [](Simulation& s, const Arguments&) { return s.Start(); }},
      {"pause",
       "Pause a simulation",
       {},
       [](Simulation& s, const Arguments&) { return s.Pause(); }},
      {"resume",
       "Resume a paused simulation",
       {},
       [](Simulation& s, const Arguments&) { return s.Resume(); }},
      {"stop",
       "Stop a simulation; then only a reset is possible",
       {},
       [](Simulation& s, const Arguments&) { return s.Stop(); }},
      {"reset",
       "Reset a simulation to its start",
       {},
       [](Simulation& s, const Arguments&) { return s.Reset(); }},
      {"step",
       "Take some steps, then pause",
       {{.name = "count",
         .type = kInteger,
         .unit = "steps",
         .summary = "number of steps",
         .minimum = 1,
         .maximum = 1e9,
         .default_value = std::int64_t{1}}},
       [](Simulation& s, const Arguments& given) {
         return s.Step(given.Get<std::int64_t>("count"));
       }},
      {"real_time_factor",
       "Set the target real-time factor of a simulation in real-time mode",
       {{.name = "real_time_factor",
         .former_name = "factor",
         .type = kNumber,
         .unit = "simulated seconds per second",
         .summary = "target real-time factor, above 0",
         .minimum = 0,
         .maximum = 1e6}},
       [](Simulation& s, const Arguments& given) {
         return s.SetRealTimeFactor(given.Get<double>("real_time_factor"));
       },
       "factor"},
      {"set_gravity",
       "Set the gravity of a created or paused simulation, along the world's z axis",
       {{.name = "z",
         .type = kNumber,
         .unit = "m/s²",
         .summary = "gravity along z, such as -1.62 on the Moon",
         .minimum = -100,
         .maximum = 100,
         .default_meaning = "the world's own"}},
       [](Simulation& s, const Arguments& given) {
         const double* const z = given.Find<double>("z");
         return s.SetGravity(z ? std::optional(*z) : std::nullopt);
       }},
  };
  return kCommands;
}

std::span<const Command> CommandsWithFormerNames() {
  static const std::vector<Command> kCommands = [] {
    std::vector<Command> commands(Commands().begin(), Commands().end());
    for (const Command& command : Commands()) {
      if (command.former_name.empty()) continue;
      commands.push_back(command);
      commands.back().name = command.former_name;
    }
    return commands;
  }();
  return kCommands;
}

const Command* FindCommand(std::string_view name) {
  const auto commands = Commands();
  const auto found = std::find_if(commands.begin(), commands.end(), [&](const Command& command) {
    return !name.empty() && (command.name == name || command.former_name == name);
  });
  return found == commands.end() ? nullptr : &*found;
}

}  // namespace gsv::simulation
