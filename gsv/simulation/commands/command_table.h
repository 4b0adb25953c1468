// The table of commands on a simulation. A command is one entry, which every front end offers with
// its name, parameters and summary.
#pragma once

#include <span>
#include <string_view>

#include "gsv/simulation/commands/command.h"

namespace gsv::simulation {

std::span<const Command> Commands();

// Null if there is none of that name.
const Command* FindCommand(std::string_view name);

}  // namespace gsv::simulation
