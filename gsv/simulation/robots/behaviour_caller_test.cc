#include "gsv/simulation/robots/behaviour_caller.h"

#include <future>

#include <gtest/gtest.h>

namespace gsv::simulation {
namespace {

TEST(BehaviourCaller, CallsOfOneKeyKeepTheirOrder) {
  std::vector<int> order;
  {
    BehaviourCaller caller(4);
    for (int i = 0; i < 100; ++i) caller.Post("robot", [&order, i] { order.push_back(i); });
  }
  ASSERT_EQ(order.size(), 100u);
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(BehaviourCaller, HangingCallDoesNotDelayOtherCalls) {
  std::promise<void> release, done;
  BehaviourCaller caller(2);
  caller.Post("hangs", [&] { release.get_future().wait(); });
  caller.Post("answers", [&] { done.set_value(); });
  done.get_future().wait();
  release.set_value();
}

}  // namespace
}  // namespace gsv::simulation
