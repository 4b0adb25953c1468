#include "apps/gsv/process/program_end.h"

#include <cstdio>
#include <cstdlib>

#include "apps/gsv/process/standard_output.h"
#include "gsv/simulation/simulation.h"

namespace gsv::app {

int EndProgram(int exit_code) {
  exit_code = EndOutput(stdout, exit_code);
  if (simulation::Simulation::AbandonedSimulations() > 0) {
    std::fflush(nullptr);
    std::_Exit(exit_code);
  }
  return exit_code;
}

}  // namespace gsv::app
