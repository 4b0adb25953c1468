#include "gsv/hosting/fibre.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace gsv::hosting {
namespace {

TEST(Fibre, IsSuspendedAndResumed) {
  std::vector<int> seen;
  Fibre* self = nullptr;
  Fibre fibre([&] {
    for (int i = 0; i < 3; ++i) {
      seen.push_back(i);
      self->Suspend();
    }
  });
  self = &fibre;
  EXPECT_TRUE(seen.empty());
  for (int i = 0; i < 3; ++i) {
    fibre.Resume();
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(i + 1));
    EXPECT_FALSE(fibre.has_ended());
  }
  fibre.Resume();
  EXPECT_TRUE(fibre.has_ended());
}

TEST(Fibre, CanBeResumedOnAnotherThread) {
  Fibre* self = nullptr;
  int sum = 0;
  Fibre fibre([&] {
    for (int i = 1; i <= 10; ++i) {
      sum += i;
      self->Suspend();
    }
  });
  self = &fibre;
  while (!fibre.has_ended()) std::thread([&] { fibre.Resume(); }).join();
  EXPECT_EQ(sum, 55);
}

TEST(Fibre, UnwindsItsStackWhenItIsDestroyed) {
  auto held = std::make_shared<int>(1);
  {
    Fibre* self = nullptr;
    Fibre fibre([&self, copy = held] {
      std::shared_ptr<int> on_the_stack;
      on_the_stack = copy;
      self->Suspend();
    });
    self = &fibre;
    fibre.Resume();
    EXPECT_EQ(held.use_count(), 3);
  }
  EXPECT_EQ(held.use_count(), 1);
}

}  // namespace
}  // namespace gsv::hosting
