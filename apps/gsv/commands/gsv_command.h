// The program gsv: its own options, all commands, and what it says about wrong arguments.
#pragma once

namespace gsv::app {

// Does what the arguments of main() say and returns the exit code. Call it from main(), before other threads start:
// it blocks signals and sets environment variables.
int RunGsv(int argc, char** argv);

}  // namespace gsv::app
