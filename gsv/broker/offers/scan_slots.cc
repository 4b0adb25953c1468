#include "gsv/broker/offers/scan_slots.h"

#include <algorithm>
#include <thread>

namespace gsv::broker {

ScanSlots::ScanSlots(std::size_t at_once) : at_once_(std::max<std::size_t>(at_once, 1)) {}

std::size_t ScanSlots::ForThisMachine() {
  const std::size_t cores = std::thread::hardware_concurrency();
  return cores > 1 ? cores - 1 : 1;
}

void ScanSlots::Take() {
  base::MutexLock lock(mutex_);
  const std::uint64_t mine = asked_++;
  changed_.wait(lock, [&]() GSV_REQUIRES(mutex_) { return mine < ended_ + at_once_; });
}

void ScanSlots::Give() {
  {
    const base::MutexLock lock(mutex_);
    ++ended_;
  }
  changed_.notify_all();
}

}  // namespace gsv::broker
