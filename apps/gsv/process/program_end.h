// Ends a program that ran simulations.
#pragma once

namespace gsv::app {

// Flushes the output and returns the exit code, see EndOutput(). If a behaviour still uses objects
// that static destructors would destroy, this function does not return: it ends the process without
// running static destructors.
int EndProgram(int exit_code);

}  // namespace gsv::app
