// The table of commands on a simulation. A command is one entry, which every front end offers with
// its name, parameters and summary.
#pragma once

#include <span>
#include <string_view>

#include "gsv/simulation/commands/command.h"

namespace gsv::simulation {

std::span<const Command> Commands();

// All commands, and again those that have a former name, under that name. For front ends whose
// clients choose a command by its name: HTTP routes and Foxglove services.
std::span<const Command> CommandsWithFormerNames();

// Finds a command by its name or its former name. Null if there is none.
const Command* FindCommand(std::string_view name);

}  // namespace gsv::simulation
