// Whether what the program printed was written.
#pragma once

#include <cstdio>

namespace gsv::app {

// Call it once, at the end of the program: writes what `output`, stdout, still buffers. If that, or
// anything before, could not be written, prints a sentence on stderr and returns kInfrastructure
// instead of kOk; other exit codes stay. A pipe whose reader has gone, as with `| head`, is no
// mistake that needs a sentence.
int EndOutput(std::FILE* output, int exit_code);

}  // namespace gsv::app
