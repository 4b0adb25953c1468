#include "gsv/broker/process_limits.h"

#include <cerrno>
#include <cstring>

#include <malloc.h>
#include <sys/resource.h>

namespace gsv::broker {

base::Status ApplyProcessLimits(const ProcessLimits& limits) {
  mallopt(M_ARENA_MAX, limits.malloc_arenas);
  rlimit address_space{};
  getrlimit(RLIMIT_AS, &address_space);
  // A limit that is lower already stays.
  if (address_space.rlim_cur <= limits.address_space_bytes) return {};
  address_space.rlim_cur = limits.address_space_bytes;
  if (setrlimit(RLIMIT_AS, &address_space) == 0) return {};
  return base::Fail(
      base::ErrorCode::kUnavailable,
      std::string("the broker's address space cannot be limited: ") + std::strerror(errno));
}

}  // namespace gsv::broker
