#include "gsv/broker/transport/process_limits.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <malloc.h>
#include <sys/resource.h>

#include "gsv/base/sanitizer.h"
#include "gsv/broker/transport/memory_reserve.h"

namespace gsv::broker {

namespace {

// Raises the limit of open descriptors to `wanted`, or as far as the system allows.
void AskForDescriptors(std::size_t wanted) {
  rlimit descriptors{};
  getrlimit(RLIMIT_NOFILE, &descriptors);
  if (descriptors.rlim_cur >= wanted) return;
  descriptors.rlim_cur = std::min<rlim_t>(wanted, descriptors.rlim_max);
  // If the system allows fewer descriptors, the broker keeps fewer connections open.
  setrlimit(RLIMIT_NOFILE, &descriptors);
}

}  // namespace

base::Status ApplyProcessLimits(const ProcessLimits& limits) {
  mallopt(M_ARENA_MAX, limits.malloc_arenas);
  AskForDescriptors(limits.descriptors);
  if (base::kReservesAddressSpace) return {};
  rlimit address_space{};
  getrlimit(RLIMIT_AS, &address_space);
  // If a lower limit is already set, it remains.
  if (address_space.rlim_cur <= limits.address_space_bytes) return {};
  address_space.rlim_cur = limits.address_space_bytes;
  if (setrlimit(RLIMIT_AS, &address_space) == 0) {
    HoldMemoryReserve(limits.address_space_bytes / 16);
    return {};
  }
  return base::Fail(
      base::ErrorCode::kUnavailable,
      std::string("the broker's address space cannot be limited: ") + std::strerror(errno));
}

std::size_t MaxConnections() {
  constexpr std::size_t kEnough = 4096;
  rlimit descriptors{};
  getrlimit(RLIMIT_NOFILE, &descriptors);
  return std::min<std::size_t>(kEnough, descriptors.rlim_cur / 2);
}

}  // namespace gsv::broker
