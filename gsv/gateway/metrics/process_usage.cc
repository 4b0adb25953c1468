#include "gsv/gateway/metrics/process_usage.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace gsv::gateway::metrics {
namespace {

// Fields of /proc/self/stat, numbered as in proc(5). The second field may contain blanks.
constexpr int kFirstAfterName = 3, kUserTime = 14, kSystemTime = 15, kThreads = 20, kStart = 22,
              kResidentPages = 24;

}  // namespace

ProcessUsage ReadProcessUsage() {
  ProcessUsage usage;
  std::ifstream file("/proc/self/stat");
  std::string line;
  std::getline(file, line);
  std::istringstream fields(line.substr(std::min(line.rfind(')') + 1, line.size())));
  const auto ticks = static_cast<double>(sysconf(_SC_CLK_TCK));
  double start_after_boot = 0;
  std::string field;
  for (int number = kFirstAfterName; number <= kResidentPages && fields >> field; ++number) {
    if (number < kUserTime) continue;
    const std::uint64_t value = std::strtoull(field.c_str(), nullptr, 10);
    if (number == kUserTime || number == kSystemTime) {
      usage.processor_seconds += static_cast<double>(value) / ticks;
    } else if (number == kThreads) {
      usage.threads = value;
    } else if (number == kStart) {
      start_after_boot = static_cast<double>(value) / ticks;
    } else if (number == kResidentPages) {
      usage.resident_bytes = value * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    }
  }
  const struct mallinfo2 heap = mallinfo2();
  usage.allocated_bytes = heap.uordblks + heap.hblkhd;
  double since_boot = 0;
  std::ifstream("/proc/uptime") >> since_boot;
  usage.uptime = since_boot - start_after_boot;
  const std::chrono::duration<double> now = std::chrono::system_clock::now().time_since_epoch();
  usage.start_time = now.count() - usage.uptime;
  std::error_code error;
  for (std::filesystem::directory_iterator each("/proc/self/fd", error), end; !error && each != end;
       each.increment(error)) {
    ++usage.descriptors;
  }
  // The descriptor that was open for counting is not counted.
  if (usage.descriptors > 0) --usage.descriptors;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) == 0) usage.max_descriptors = limit.rlim_cur;
  return usage;
}

}  // namespace gsv::gateway::metrics
