#include "gsv/base/mutex.h"

#include <thread>

#include <gtest/gtest.h>

namespace gsv::base {
namespace {

using std::chrono::milliseconds;

TEST(ConditionVariable, WakesAWaiterThatThenHoldsTheMutex) {
  Mutex mutex;
  ConditionVariable changed;
  bool is_ready = false;
  std::thread other([&] {
    const MutexLock lock(mutex);
    is_ready = true;
    changed.notify_one();
  });
  {
    MutexLock lock(mutex);
    changed.wait(lock, [&] { return is_ready; });
    bool is_free = true;
    std::thread([&] {
      is_free = mutex.try_lock();
      if (is_free) mutex.unlock();
    }).join();
    EXPECT_FALSE(is_free);
  }
  other.join();
  EXPECT_TRUE(mutex.try_lock());
  mutex.unlock();
}

TEST(ConditionVariable, ReturnsThePredicateWhenTheTimeIsOver) {
  Mutex mutex;
  ConditionVariable changed;
  MutexLock lock(mutex);
  EXPECT_FALSE(changed.wait_for(lock, milliseconds(1), [] { return false; }));
  EXPECT_EQ(changed.wait_for(lock, milliseconds(1)), std::cv_status::timeout);
}

TEST(MutexLock, ReleasesTheMutexBetweenUnlockAndLock) {
  Mutex mutex;
  {
    MutexLock lock(mutex);
    lock.unlock();
    EXPECT_TRUE(mutex.try_lock());
    mutex.unlock();
    lock.lock();
    lock.unlock();
  }
  EXPECT_TRUE(mutex.try_lock());  // the end of a lock that was unlocked releases nothing twice
  mutex.unlock();
}

TEST(ReaderLock, LetsOtherReadersInAndNoWriter) {
  SharedMutex mutex;
  bool has_written = false;
  std::thread writer;
  {
    const ReaderLock mine(mutex);
    bool has_read = false;
    std::thread([&] {
      const ReaderLock lock(mutex);
      has_read = true;
    }).join();
    EXPECT_TRUE(has_read);
    writer = std::thread([&] {
      const WriterLock lock(mutex);
      has_written = true;
    });
    EXPECT_FALSE(has_written);
  }
  writer.join();
  EXPECT_TRUE(has_written);
}

}  // namespace
}  // namespace gsv::base
