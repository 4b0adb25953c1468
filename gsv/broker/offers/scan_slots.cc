#include "gsv/broker/offers/scan_slots.h"

#include <algorithm>
#include <thread>

namespace gsv::broker {

ScanSlots::ScanSlots(std::size_t slots) : slot_count_(std::max<std::size_t>(slots, 1)) {}

std::size_t ScanSlots::ForThisMachine() {
  const std::size_t cores = std::thread::hardware_concurrency();
  return cores > 1 ? cores - 1 : 1;
}

void ScanSlots::Acquire() {
  base::MutexLock lock(mutex_);
  const std::uint64_t mine = requests_++;
  changed_.wait(lock, [&]() GSV_REQUIRES(mutex_) { return mine < released_ + slot_count_; });
}

void ScanSlots::Release() {
  {
    const base::MutexLock lock(mutex_);
    ++released_;
  }
  changed_.notify_all();
}

}  // namespace gsv::broker
