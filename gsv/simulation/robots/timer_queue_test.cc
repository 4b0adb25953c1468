#include "gsv/simulation/robots/timer_queue.h"

#include <gtest/gtest.h>

namespace gsv::simulation {
namespace {

using namespace std::chrono_literals;

std::vector<int> Due(TimerQueue<int>& calendar, base::SimTime now) {
  std::vector<int> woken;
  calendar.TakeDue(now, [&](int& sleeper) { woken.push_back(sleeper); });
  return woken;
}

TEST(TimerQueue, WakesInTheOrderOfInstantsAndEntries) {
  int one = 1, two = 2, three = 3;
  TimerQueue<int> calendar;
  calendar.Add(20ms, &two);
  calendar.Add(10ms, &three);
  calendar.Add(20ms, &one);
  EXPECT_FALSE(calendar.HasDue(9ms));
  EXPECT_TRUE(Due(calendar, 9ms).empty());
  EXPECT_TRUE(calendar.HasDue(10ms));
  EXPECT_EQ(Due(calendar, 25ms), (std::vector{3, 2, 1}));
  EXPECT_TRUE(Due(calendar, 25ms).empty());
}

TEST(TimerQueue, WokenAgentMayAddItselfAgain) {
  int one = 1;
  TimerQueue<int> calendar;
  calendar.Add(10ms, &one);
  int wakes = 0;
  calendar.TakeDue(10ms, [&](int& sleeper) {
    ++wakes;
    calendar.Add(20ms, &sleeper);
  });
  EXPECT_EQ(wakes, 1);
  EXPECT_EQ(Due(calendar, 20ms), std::vector{1});
}

TEST(TimerQueue, AppendsDueAgentsInTheSameOrder) {
  int one = 1, two = 2, three = 3;
  TimerQueue<int> calendar;
  calendar.Add(20ms, &two);
  calendar.Add(10ms, &three);
  calendar.Add(20ms, &one);
  calendar.Add(30ms, &three);
  std::vector<int*> due{&one};
  calendar.TakeDue(20ms, due);
  EXPECT_EQ(due, (std::vector<int*>{&one, &three, &two, &one}));
  EXPECT_EQ(Due(calendar, 30ms), std::vector{3});
}

TEST(TimerQueue, ReturnsTheNextInstantUpToALimit) {
  int one = 1;
  TimerQueue<int> calendar;
  EXPECT_EQ(calendar.Next(15ms), 15ms);
  calendar.Add(20ms, &one);
  calendar.Add(10ms, &one);
  EXPECT_EQ(calendar.Next(15ms), 10ms);
  EXPECT_EQ(calendar.Next(5ms), 5ms);
}

TEST(TimerQueue, RemovesAllEntriesOfAnAgent) {
  int one = 1, two = 2;
  TimerQueue<int> calendar;
  for (const auto instant : {10ms, 20ms}) {
    calendar.Add(instant, &one);
    calendar.Add(instant, &two);
  }
  calendar.Remove(&one);
  EXPECT_EQ(Due(calendar, 30ms), (std::vector{2, 2}));
}

}  // namespace
}  // namespace gsv::simulation
