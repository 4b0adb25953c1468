// The standard library's mutexes with annotations for clang's thread-safety analysis.
//
//   base::Mutex mutex_;
//   int count_ GSV_GUARDED_BY(mutex_) = 0;
//   …
//   const base::MutexLock lock(mutex_);
//   ++count_;
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <shared_mutex>

#include "gsv/base/thread_safety.h"

namespace gsv::base {

// std::mutex with annotations.
class GSV_CAPABILITY("mutex") Mutex {
 public:
  Mutex() = default;
  Mutex(const Mutex&) = delete;
  Mutex& operator=(const Mutex&) = delete;

  void lock() GSV_ACQUIRE() { mutex_.lock(); }
  void unlock() GSV_RELEASE() { mutex_.unlock(); }
  bool try_lock() GSV_TRY_ACQUIRE(true) { return mutex_.try_lock(); }
  // Declares to the analysis that the calling thread holds the mutex. Checks nothing at run time.
  void AssertHeld() const GSV_ASSERT_HELD(this) {}

 private:
  friend class ConditionVariable;
  std::mutex mutex_;
};

// std::timed_mutex with annotations.
class GSV_CAPABILITY("mutex") TimedMutex {
 public:
  TimedMutex() = default;
  TimedMutex(const TimedMutex&) = delete;
  TimedMutex& operator=(const TimedMutex&) = delete;

  void lock() GSV_ACQUIRE() { mutex_.lock(); }
  void unlock() GSV_RELEASE() { mutex_.unlock(); }
  bool try_lock() GSV_TRY_ACQUIRE(true) { return mutex_.try_lock(); }
  template <class Rep, class Period>
  bool try_lock_for(const std::chrono::duration<Rep, Period>& time) GSV_TRY_ACQUIRE(true) {
    return mutex_.try_lock_for(time);
  }
  void AssertHeld() const GSV_ASSERT_HELD(this) {}

 private:
  std::timed_mutex mutex_;
};

// std::shared_mutex with annotations.
class GSV_CAPABILITY("mutex") SharedMutex {
 public:
  SharedMutex() = default;
  SharedMutex(const SharedMutex&) = delete;
  SharedMutex& operator=(const SharedMutex&) = delete;

  void lock() GSV_ACQUIRE() { mutex_.lock(); }
  void unlock() GSV_RELEASE() { mutex_.unlock(); }
  void lock_shared() GSV_ACQUIRE_SHARED() { mutex_.lock_shared(); }
  void unlock_shared() GSV_RELEASE_SHARED() { mutex_.unlock_shared(); }
  void AssertHeld() const GSV_ASSERT_HELD(this) {}

 private:
  std::shared_mutex mutex_;
};

// Locks a mutex for its lifetime, except between unlock() and lock().
template <class M>
class GSV_SCOPED_CAPABILITY ScopedLock {
 public:
  explicit ScopedLock(M& mutex) GSV_ACQUIRE(mutex) : mutex_(mutex) { mutex_.lock(); }
  // The calling thread holds `mutex` already.
  ScopedLock(M& mutex, std::adopt_lock_t /*tag*/) GSV_REQUIRES(mutex) : mutex_(mutex) {}
  ~ScopedLock() GSV_RELEASE() {
    if (is_held_) mutex_.unlock();
  }
  ScopedLock(const ScopedLock&) = delete;
  ScopedLock& operator=(const ScopedLock&) = delete;

  void lock() GSV_ACQUIRE() {
    mutex_.lock();
    is_held_ = true;
  }
  void unlock() GSV_RELEASE() {
    is_held_ = false;
    mutex_.unlock();
  }

 private:
  friend class ConditionVariable;
  M& mutex_;
  bool is_held_ = true;
};

using MutexLock = ScopedLock<Mutex>;
using TimedMutexLock = ScopedLock<TimedMutex>;
using WriterLock = ScopedLock<SharedMutex>;

// Holds a shared lock of a SharedMutex for its lifetime.
class GSV_SCOPED_CAPABILITY ReaderLock {
 public:
  explicit ReaderLock(SharedMutex& mutex) GSV_ACQUIRE_SHARED(mutex) : mutex_(mutex) {
    mutex_.lock_shared();
  }
  ~ReaderLock() GSV_RELEASE_GENERIC() {
    if (is_held_) mutex_.unlock_shared();
  }
  ReaderLock(const ReaderLock&) = delete;
  ReaderLock& operator=(const ReaderLock&) = delete;

  void lock() GSV_ACQUIRE_SHARED() {
    mutex_.lock_shared();
    is_held_ = true;
  }
  void unlock() GSV_RELEASE_GENERIC() {
    is_held_ = false;
    mutex_.unlock_shared();
  }

 private:
  SharedMutex& mutex_;
  bool is_held_ = true;
};

// A condition variable for MutexLock, which the caller holds. Predicates are called with the lock
// held. A predicate that reads guarded members is declared [this]() GSV_REQUIRES(mutex_) { return
// is_done_; }.
class ConditionVariable {
 public:
  void notify_one() { condition_.notify_one(); }
  void notify_all() { condition_.notify_all(); }

  void wait(MutexLock& lock) {
    Inner inner(lock);
    condition_.wait(inner.lock);
  }
  template <class Predicate>
  void wait(MutexLock& lock, Predicate predicate) {
    Inner inner(lock);
    condition_.wait(inner.lock, predicate);
  }
  template <class Time>
  std::cv_status wait_until(MutexLock& lock, const Time& time) {
    Inner inner(lock);
    return condition_.wait_until(inner.lock, time);
  }
  template <class Time, class Predicate>
  bool wait_until(MutexLock& lock, const Time& time, Predicate predicate) {
    Inner inner(lock);
    return condition_.wait_until(inner.lock, time, predicate);
  }
  template <class Duration>
  std::cv_status wait_for(MutexLock& lock, const Duration& time) {
    Inner inner(lock);
    return condition_.wait_for(inner.lock, time);
  }
  template <class Duration, class Predicate>
  bool wait_for(MutexLock& lock, const Duration& time, Predicate predicate) {
    Inner inner(lock);
    return condition_.wait_for(inner.lock, time, predicate);
  }

 private:
  // The std::unique_lock that the standard library needs. Its destructor leaves the mutex locked.
  struct Inner {
    explicit Inner(MutexLock& outer) : lock(outer.mutex_.mutex_, std::adopt_lock) {}
    ~Inner() { lock.release(); }
    Inner(const Inner&) = delete;
    Inner& operator=(const Inner&) = delete;
    std::unique_lock<std::mutex> lock;
  };

  std::condition_variable condition_;
};

}  // namespace gsv::base
