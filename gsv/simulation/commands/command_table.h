// The table of commands on a simulation. Each command is one entry, which every front end offers
// with its name, parameters and summary.
#pragma once

#include <span>
#include <string_view>

#include "gsv/simulation/commands/command.h"

namespace gsv::simulation {

// All commands under their present names.
std::span<const Command> Commands();

// All commands. A command with a former name has a second entry under that name. Front ends whose
// clients choose a command by its name need both: HTTP routes and Foxglove services.
std::span<const Command> CommandsWithFormerNames();

// Finds a command by its name or its former name. Returns null if there is none.
const Command* FindCommand(std::string_view name);

}  // namespace gsv::simulation
