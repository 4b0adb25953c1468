#include "gsv/broker/offers/scan_turns.h"

#include <algorithm>
#include <thread>

namespace gsv::broker {

ScanTurns::ScanTurns(std::size_t at_once) : at_once_(std::max<std::size_t>(at_once, 1)) {}

std::size_t ScanTurns::ForThisMachine() {
  const std::size_t cores = std::thread::hardware_concurrency();
  return cores > 1 ? cores - 1 : 1;
}

void ScanTurns::Take() {
  base::MutexLock lock(mutex_);
  const std::uint64_t mine = asked_++;
  changed_.wait(lock, [&]() GSV_REQUIRES(mutex_) { return mine < ended_ + at_once_; });
}

void ScanTurns::Give() {
  {
    const base::MutexLock lock(mutex_);
    ++ended_;
  }
  changed_.notify_all();
}

}  // namespace gsv::broker
