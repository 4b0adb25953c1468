// Limits the number of threads that scan many offers at the same time, so that one core remains
// free for short queries. A long query waits for a slot. Slots are given in the order of the
// requests.
//
// Threads  any.
#pragma once

#include <cstddef>
#include <cstdint>

#include "gsv/base/mutex.h"

namespace gsv::broker {

class ScanSlots {
 public:
  // `slots` is the number of scans that run at the same time, >= 1.
  explicit ScanSlots(std::size_t slots);
  // Returns the number of cores minus one, but at least 1.
  static std::size_t ForThisMachine();

  // Waits for a slot and occupies it.
  void Acquire();
  // Frees one slot that Acquire() has occupied.
  void Release();

 private:
  const std::uint64_t slot_count_;
  base::Mutex mutex_;
  base::ConditionVariable changed_;                    // notified when a slot is freed
  std::uint64_t requests_ GSV_GUARDED_BY(mutex_) = 0;  // number of calls of Acquire()
  std::uint64_t released_ GSV_GUARDED_BY(mutex_) = 0;  // number of calls of Release()
};

// Holds a slot during its lifetime. For a scan that needs no slot, pass null; then the object does
// nothing.
class ScanSlot {
 public:
  explicit ScanSlot(ScanSlots* slots) : slots_(slots) { Resume(); }
  ~ScanSlot() { Pause(); }
  ScanSlot(const ScanSlot&) = delete;
  ScanSlot& operator=(const ScanSlot&) = delete;

  // Releases the slot while the thread waits for something else. Resume() waits for a slot again.
  void Pause() {
    if (slots_ != nullptr) slots_->Release();
  }
  // Waits until a slot is free, and takes it.
  void Resume() {
    if (slots_ != nullptr) slots_->Acquire();
  }

 private:
  ScanSlots* const slots_;  // null for a scan that needs no slot
};

}  // namespace gsv::broker
