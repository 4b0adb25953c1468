#include "apps/gsv/process/standard_output.h"

#include <poll.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "apps/gsv/process/exit_code.h"

namespace gsv::app {
namespace {

bool HasLostItsReader(std::FILE* output) {
  pollfd descriptor{fileno(output), POLLOUT, 0};
  return poll(&descriptor, 1, 0) == 1 && (descriptor.revents & POLLERR) != 0;
}

}  // namespace

int EndOutput(std::FILE* output, int exit_code) {
  const bool has_failed = std::ferror(output) != 0;
  const bool is_flushed = std::fflush(output) == 0;
  const int error = is_flushed ? 0 : errno;
  if (!has_failed && is_flushed) return exit_code;
  if (error != EPIPE && !HasLostItsReader(output)) {
    const std::string why = error != 0 ? std::string(": ") + std::strerror(error) : "";
    std::fprintf(
        stderr,
        "gsv: cannot write all output to standard output%s; check the free space of the disk\n",
        why.c_str());
  }
  return exit_code == kOk ? static_cast<int>(kInfrastructure) : exit_code;
}

}  // namespace gsv::app
