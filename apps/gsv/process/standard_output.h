// Checks that the program's output was written.
#pragma once

#include <cstdio>

namespace gsv::app {

// Call it once, at the end of the program. It flushes `output`, which is stdout. If this or an
// earlier write failed, it prints a sentence on stderr and returns kInfrastructure instead of kOk.
// Other exit codes do not change. It prints no sentence for a pipe whose reader has ended, as with
// `| head`.
int EndOutput(std::FILE* output, int exit_code);

}  // namespace gsv::app
