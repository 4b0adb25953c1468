#include "tests/support/other_host.h"

#include <csignal>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace gsv::testing {

OtherHost::OtherHost(int milliseconds)
    : link_(std::string(std::getenv("GSV_SOURCE_DIR")) + "/tests/support/slow_link.py",
            {std::to_string(milliseconds)}) {
  const auto line = link_.process().ReadLine(kProgramTimeout);
  if (!line) {
    const Outcome outcome = link_.AwaitEnd();
    if (outcome.ending != "exit code 77") throw std::runtime_error(outcome.ending + outcome.err);
    refusal_ = outcome.err;
    return;
  }
  std::istringstream words(*line);
  std::string ready;
  if (!(words >> ready >> network_ >> address_here_)) throw std::runtime_error(*line);
}

std::vector<std::string> OtherHost::wrapper() const {
  return {"ip",     "netns",   "exec",
          network_, "unshare", "--uts",
          "sh",     "-c",      "hostname elsewhere && exec \"$@\"",
          "sh"};
}

void OtherHost::Cut() { link_.process().Signal(SIGSTOP); }

void OtherHost::Mend() { link_.process().Signal(SIGCONT); }

}  // namespace gsv::testing
