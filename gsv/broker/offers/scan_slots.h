// Limits the number of threads that scan many offers at the same time. One core remains free for
// short queries. Long queries take turns in the order of their arrival.
//
// Threads  any.
#pragma once

#include <cstddef>
#include <cstdint>

#include "gsv/base/mutex.h"

namespace gsv::broker {

class ScanSlots {
 public:
  // `at_once` is the number of concurrent turns, >= 1.
  explicit ScanSlots(std::size_t at_once);
  // Returns the number of cores minus one, but at least 1.
  static std::size_t ForThisMachine();

  void Take();
  void Give();

 private:
  const std::uint64_t at_once_;
  base::Mutex mutex_;
  base::ConditionVariable changed_;
  std::uint64_t asked_ GSV_GUARDED_BY(mutex_) = 0;
  std::uint64_t ended_ GSV_GUARDED_BY(mutex_) = 0;
};

// Holds a turn during its lifetime. Null stands for a scan that needs no turn.
class ScanSlot {
 public:
  explicit ScanSlot(ScanSlots* turns) : turns_(turns) { Resume(); }
  ~ScanSlot() { Pause(); }
  ScanSlot(const ScanSlot&) = delete;
  ScanSlot& operator=(const ScanSlot&) = delete;

  // Releases the turn while the holder waits for something else.
  void Pause() {
    if (turns_ != nullptr) turns_->Give();
  }
  void Resume() {
    if (turns_ != nullptr) turns_->Take();
  }

 private:
  ScanSlots* const turns_;
};

}  // namespace gsv::broker
