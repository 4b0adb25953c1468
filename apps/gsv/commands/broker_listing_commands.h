// `gsv offers`, `gsv types` and `gsv links`: list, add and remove a broker's entries.
#pragma once

#include "apps/gsv/commands/commands.h"

namespace gsv::app {

void AddOffersCommand(const CommandLine& line);
void AddTypesCommand(const CommandLine& line);
void AddLinksCommand(const CommandLine& line);

}  // namespace gsv::app
