#include "gsv/gateway/server/worker_pool.h"

#include <atomic>
#include <future>
#include <thread>

#include <gtest/gtest.h>

namespace gsv::gateway {
namespace {

TEST(WorkerPool, RefusesJobsBeyondItsLimit) {
  WorkerPool pool(1, 2);
  std::promise<void> begun, release;
  ASSERT_TRUE(pool.Submit([&] {
    begun.set_value();
    release.get_future().wait();
  }));
  begun.get_future().wait();
  std::promise<void> last;
  EXPECT_TRUE(pool.Submit([] {}));
  EXPECT_TRUE(pool.Submit([&] { last.set_value(); }));
  EXPECT_FALSE(pool.Submit([] {}));
  release.set_value();
  last.get_future().wait();
  EXPECT_TRUE(pool.Submit([] {}));
}

TEST(WorkerPool, StopWaitsForRunningJobsAndDropsTheRest) {
  std::atomic<int> done{0};
  std::promise<void> begun;
  std::promise<void> release;
  WorkerPool pool(1, std::size_t{1} << 30);
  ASSERT_TRUE(pool.Submit([&] {
    begun.set_value();
    release.get_future().wait();
    ++done;
  }));
  begun.get_future().wait();
  ASSERT_TRUE(pool.Submit([&] { done += 100; }));
  std::thread stopper([&] { pool.Stop(); });
  // Waits until Stop() has dropped the queued jobs. From then on, the pool accepts no job.
  while (pool.Submit([&] { done += 100; })) std::this_thread::yield();
  release.set_value();
  stopper.join();
  EXPECT_EQ(done, 1);
  EXPECT_FALSE(pool.Submit([] {}));
}

}  // namespace
}  // namespace gsv::gateway
