// Limits how many threads scan many offers at the same time. One core stays free of that, so that
// short queries are answered meanwhile; the long ones go one after the other as they came.
//
// Threads  any.
#pragma once

#include <cstddef>
#include <cstdint>

#include "gsv/base/mutex.h"

namespace gsv::broker {

class ScanSlots {
 public:
  // `at_once` have a turn at a time, at least one.
  explicit ScanSlots(std::size_t at_once);
  // As many as there are cores, but for one.
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

// A turn as long as this lives; null: none is needed.
class ScanSlot {
 public:
  explicit ScanSlot(ScanSlots* turns) : turns_(turns) { Resume(); }
  ~ScanSlot() { Pause(); }
  ScanSlot(const ScanSlot&) = delete;
  ScanSlot& operator=(const ScanSlot&) = delete;

  // Others go on while the holder waits for something else.
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
