// `gsv offers`, `gsv types` and `gsv links`: what a broker has, listed, added to and removed from.
#pragma once

#include "apps/gsv/commands/commands.h"

namespace gsv::app {

void AddOffersCommand(const CommandLine& line);
void AddTypesCommand(const CommandLine& line);
void AddLinksCommand(const CommandLine& line);

}  // namespace gsv::app
