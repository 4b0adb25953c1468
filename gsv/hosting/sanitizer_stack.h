// Notifies the sanitizers when a thread switches stacks (sanitizer/common_interface_defs.h,
// asan_interface.h, tsan_interface.h). Does nothing in other builds.
//
// Threads  one at a time.
#pragma once

#include <cstddef>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#elif defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace gsv::hosting {

#if defined(__SANITIZE_ADDRESS__)

class SanitizerStack {
 public:
  // `bottom` is the lowest address of the stack.
  SanitizerStack(const void* bottom, std::size_t size) : bottom_(bottom), size_(size) {}

  // Call this on another stack, before Boost.Context creates a context on this stack.
  // AddressSanitizer may still mark these addresses as invalid: an earlier stack was here, and its
  // last calls never returned.
  void BeforePreparing() { __asan_unpoison_memory_region(bottom_, size_); }
  // Call this after Boost.Context has created the context.
  void AfterPreparing() {}

  // Call BeforeEntering() just before the thread switches to this stack, and AfterLeaving() just
  // after the thread is back.
  void BeforeEntering() { __sanitizer_start_switch_fiber(&outside_frames_, bottom_, size_); }
  void AfterLeaving() { __sanitizer_finish_switch_fiber(outside_frames_, nullptr, nullptr); }

  // Call AfterEntering() just after each entry to this stack, and BeforeLeaving() just before each
  // exit.
  void AfterEntering() {
    __sanitizer_finish_switch_fiber(frames_, &outside_bottom_, &outside_size_);
  }
  void BeforeLeaving() { __sanitizer_start_switch_fiber(&frames_, outside_bottom_, outside_size_); }
  // Like BeforeLeaving(), for the last exit: the stack is not entered again.
  void BeforeLeavingForGood() {
    __sanitizer_start_switch_fiber(nullptr, outside_bottom_, outside_size_);
  }

 private:
  const void* bottom_;
  std::size_t size_;
  const void* outside_bottom_ = nullptr;  // the stack from which this stack was entered
  std::size_t outside_size_ = 0;
  void* frames_ = nullptr;          // AddressSanitizer's data about this stack while it is left
  void* outside_frames_ = nullptr;  // AddressSanitizer's data about the other stack
};

#elif defined(__SANITIZE_THREAD__)

class SanitizerStack {
 public:
  SanitizerStack(const void*, std::size_t) : inside_(__tsan_create_fiber(0)) {}
  ~SanitizerStack() { __tsan_destroy_fiber(inside_); }
  SanitizerStack(const SanitizerStack&) = delete;
  SanitizerStack& operator=(const SanitizerStack&) = delete;

  void BeforePreparing() { BeforeEntering(); }
  void AfterPreparing() { BeforeLeaving(); }
  void BeforeEntering() {
    outside_ = __tsan_get_current_fiber();
    __tsan_switch_to_fiber(inside_, 0);
  }
  void AfterLeaving() {}
  void AfterEntering() {}
  void BeforeLeaving() { __tsan_switch_to_fiber(outside_, 0); }
  void BeforeLeavingForGood() { BeforeLeaving(); }

 private:
  void* inside_;             // ThreadSanitizer's fibre for this stack
  void* outside_ = nullptr;  // the fibre from which this stack was entered
};

#else

class SanitizerStack {
 public:
  SanitizerStack(const void*, std::size_t) {}

  void BeforePreparing() {}
  void AfterPreparing() {}
  void BeforeEntering() {}
  void AfterLeaving() {}
  void AfterEntering() {}
  void BeforeLeaving() {}
  void BeforeLeavingForGood() {}
};

#endif

}  // namespace gsv::hosting
