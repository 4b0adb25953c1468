// The end of a program that ran simulations.
#pragma once

namespace gsv::app {

// Flushes what was printed, and returns the exit code; see EndOutput(). Does not return if a
// behaviour still works on what static destructors would destroy: then it exits without them.
int EndProgram(int exit_code);

}  // namespace gsv::app
