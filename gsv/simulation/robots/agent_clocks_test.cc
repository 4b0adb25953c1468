#include "gsv/simulation/robots/agent_clocks.h"

#include <gtest/gtest.h>

namespace gsv::simulation {
namespace {

using namespace std::chrono_literals;

std::uint64_t HashOf(const AgentClocks& clocks) {
  base::Hash hash;
  clocks.AddToHash(hash);
  return hash.Digest();
}

TEST(AgentClocks, RunFromTheStartUntilTheFirstWait) {
  AgentClocks clocks;
  EXPECT_TRUE(clocks.IsRunning());
  EXPECT_FALSE(clocks.IsFinished());
  const ClockId clock = clocks.Open();
  EXPECT_TRUE(clocks.IsRunning());
  EXPECT_FALSE(clocks.WaitUntil(clock, 50ms, 0ms));
  EXPECT_FALSE(clocks.IsRunning());
}

TEST(AgentClocks, AWaitEndsAtTheFirstInstantAtOrAfterIt) {
  AgentClocks clocks;
  const ClockId clock = clocks.Open();
  clocks.WaitUntil(clock, 25ms, 0ms);
  EXPECT_FALSE(clocks.Wake(20ms));
  EXPECT_FALSE(clocks.IsRunning());
  EXPECT_TRUE(clocks.Wake(30ms));
  EXPECT_TRUE(clocks.IsRunning());
}

TEST(AgentClocks, AWaitForThePresentOrAPastInstantReturnsAtOnce) {
  AgentClocks clocks;
  const ClockId clock = clocks.Open();
  EXPECT_TRUE(clocks.WaitUntil(clock, 30ms, 30ms));
  EXPECT_TRUE(clocks.WaitUntil(clock, 10ms, 30ms));
  EXPECT_TRUE(clocks.IsRunning());
}

TEST(AgentClocks, ARepeatedWaitIsTheSameWait) {
  AgentClocks clocks;
  const ClockId clock = clocks.Open();
  EXPECT_FALSE(clocks.WaitUntil(clock, 50ms, 0ms));
  const std::uint64_t before = HashOf(clocks);
  EXPECT_FALSE(clocks.WaitUntil(clock, 50ms, 0ms));
  EXPECT_EQ(HashOf(clocks), before);
}

TEST(AgentClocks, RepeatedWaitForThePresentInstantIsPendingUntilWake) {
  AgentClocks clocks;
  const ClockId clock = clocks.Open();
  clocks.WaitUntil(clock, 50ms, 0ms);
  const std::uint64_t before = HashOf(clocks);
  EXPECT_FALSE(clocks.WaitUntil(clock, 50ms, 50ms));
  EXPECT_EQ(HashOf(clocks), before);
  EXPECT_TRUE(clocks.Wake(50ms));
  EXPECT_TRUE(clocks.WaitUntil(clock, 50ms, 50ms));
}

TEST(AgentClocks, TheAgentWaitsOnlyWhenAllOfItsClocksDo) {
  AgentClocks clocks;
  const ClockId first = clocks.Open();
  const ClockId second = clocks.Open();
  clocks.WaitUntil(first, 50ms, 0ms);
  EXPECT_TRUE(clocks.IsRunning());
  clocks.WaitUntil(second, 20ms, 0ms);
  EXPECT_FALSE(clocks.IsRunning());
  EXPECT_TRUE(clocks.Wake(20ms));
  EXPECT_TRUE(clocks.IsRunning());
}

TEST(AgentClocks, HaveFinishedWhenAllAreClosed) {
  AgentClocks clocks;
  const ClockId first = clocks.Open();
  const ClockId second = clocks.Open();
  clocks.Close(first);
  EXPECT_FALSE(clocks.IsFinished());
  clocks.Close(second);
  EXPECT_TRUE(clocks.IsFinished());
  EXPECT_FALSE(clocks.IsRunning());
}

TEST(AgentClocks, HashDependsOnWaitsAndCycles) {
  AgentClocks clocks;
  const ClockId clock = clocks.Open();
  const std::uint64_t running = HashOf(clocks);
  clocks.WaitUntil(clock, 50ms, 0ms);
  const std::uint64_t waiting = HashOf(clocks);
  EXPECT_NE(running, waiting);
  clocks.set_last_cycle(clock, 1);
  EXPECT_NE(HashOf(clocks), waiting);
}

}  // namespace
}  // namespace gsv::simulation
