#include "gsv/simulation/robots/event_signaler.h"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

namespace gsv::simulation {
namespace {

constexpr std::chrono::seconds kLong(60);

TEST(WaitEvent, ReleasesOnlyEarlierWaiters) {
  WaitEvent wait_event;
  const std::uint64_t before = wait_event.signals();
  wait_event.Open();
  EXPECT_TRUE(wait_event.WaitAfter(before, WallNow() + kLong));
  EXPECT_FALSE(wait_event.WaitAfter(wait_event.signals(), WallNow()));
}

// The caller signals a few events, the signaler's thread signals many, and the destructor signals
// the remaining events.
class EventSignalerTest : public testing::TestWithParam<int> {};

TEST_P(EventSignalerTest, SignalsEachEventOnce) {
  std::vector<std::shared_ptr<WaitEvent>> all;
  for (int i = 0; i < GetParam(); ++i) all.push_back(std::make_shared<WaitEvent>());
  std::atomic<int> passed = 0;
  {
    std::vector<std::jthread> waiting;
    for (const auto& wait_event : all) {
      waiting.emplace_back(
          [wait_event, &passed] { passed += wait_event->WaitAfter(0, WallNow() + kLong); });
    }
    EventSignaler opener;
    EventSignaler::Events events(all.begin(), all.end());
    opener.Open(events);
    EXPECT_TRUE(events.empty());
  }
  EXPECT_EQ(passed, GetParam());
  for (const auto& wait_event : all) EXPECT_EQ(wait_event->signals(), 1u);
}

INSTANTIATE_TEST_SUITE_P(FewAndMany, EventSignalerTest, testing::Values(1, 8, 9, 100));

}  // namespace
}  // namespace gsv::simulation
