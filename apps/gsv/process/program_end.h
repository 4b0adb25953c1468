// Ends a program that ran simulations.
#pragma once

namespace gsv::app {

// Flushes the output and returns the exit code, see EndOutput(). If a behaviour still works on
// objects that static destructors would destroy, it does not return: it exits without running them.
int EndProgram(int exit_code);

}  // namespace gsv::app
