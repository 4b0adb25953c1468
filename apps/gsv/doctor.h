// `gsv doctor`: what this machine lacks, and how fast it draws.
#pragma once

namespace gsv::app {

// Prints a line for each thing it looks at; gives the exit code.
int Doctor();

}  // namespace gsv::app
