#include "gsv/gateway/live/simulation_commands.h"

#include <algorithm>

namespace gsv::gateway {

using simulation::Simulation;

std::span<const SimulationCommand> SimulationCommands() {
  static constexpr SimulationCommand kCommands[]{
      {"start", "Start a simulation, or a replay from its beginning", false,
       [](Simulation& s, std::int64_t) { return s.Start(); }},
      {"pause", "Pause a simulation", false, [](Simulation& s, std::int64_t) { return s.Pause(); }},
      {"resume", "Resume a simulation that is paused", false,
       [](Simulation& s, std::int64_t) { return s.Resume(); }},
      {"stop", "End a simulation; a replay goes to its beginning", false,
       [](Simulation& s, std::int64_t) { return s.Stop(); }},
      {"reset", "Go back to the start", false,
       [](Simulation& s, std::int64_t) { return s.Reset(); }},
      {"step", "Take some steps, then pause", true,
       [](Simulation& s, std::int64_t count) { return s.Step(count); }},
  };
  return kCommands;
}

const SimulationCommand* FindSimulationCommand(std::string_view name) {
  const auto commands = SimulationCommands();
  const auto found = std::find_if(commands.begin(), commands.end(),
                                  [&](const auto& command) { return command.name == name; });
  return found == commands.end() ? nullptr : &*found;
}

}  // namespace gsv::gateway
