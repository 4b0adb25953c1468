// The program gsv: its own options, all commands, and the messages about wrong arguments.
#pragma once

namespace gsv::app {

// Runs the command that the arguments of main() give, and returns the exit code. Call it from
// main(), before other threads start, because it blocks signals and sets environment variables.
int RunGsv(int argc, char** argv);

}  // namespace gsv::app
