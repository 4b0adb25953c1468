#include "gsv/base/mutex.h"

#include <thread>

#include <gtest/gtest.h>

namespace gsv::base {
namespace {

using std::chrono::milliseconds;

bool IsFree(Mutex& mutex) {
  if (!mutex.try_lock()) return false;
  mutex.unlock();
  return true;
}

TEST(ConditionVariable, WakesAWaiterWhichThenHoldsTheMutex) {
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
    std::thread([&] { is_free = IsFree(mutex); }).join();
    EXPECT_FALSE(is_free);
  }
  other.join();
  EXPECT_TRUE(IsFree(mutex));
}

TEST(ConditionVariable, ReturnsThePredicateAfterATimeout) {
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
    EXPECT_TRUE(IsFree(mutex));
    lock.lock();
    lock.unlock();
  }
  // The destructor of a lock does not unlock a mutex that unlock() has already released.
  EXPECT_TRUE(IsFree(mutex));
}

TEST(ReaderLock, AllowsOtherReadersButNoWriter) {
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
