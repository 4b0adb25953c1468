// Checks that the program's output was written.
#pragma once

#include <cstdio>

namespace gsv::app {

// Call this function once, at the end of the program. It flushes `output`, which is stdout. If the
// flush or an earlier write failed, it prints a sentence on stderr and returns kInfrastructure
// instead of kOk. Other exit codes do not change. If `output` is a pipe whose reader has ended, as
// with `| head`, it prints no sentence.
int EndOutput(std::FILE* output, int exit_code);

}  // namespace gsv::app
