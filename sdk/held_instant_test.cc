#include "sdk/held_instant.h"

#include <limits>

#include <gtest/gtest.h>

namespace gsv::sdk {
namespace {

TEST(HeldInstant, ReadingsStayValidUntilTheNextWait) {
  HeldInstant held;
  Reading reading;
  EXPECT_FALSE(held.Read("sonar", reading));
  EXPECT_EQ(held.End().sensors, std::vector<std::string>{"sonar"});
  held.Begin(50ms, {{"sonar", 50ms, {2.5}, {}}});
  EXPECT_EQ(held.now(), SimTime(50ms));
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(held.Read("sonar", reading));
    EXPECT_EQ(reading.values, std::vector<double>{2.5});
  }
  EXPECT_FALSE(held.Read("imu", reading));
  EXPECT_EQ(held.End().sensors, (std::vector<std::string>{"imu", "sonar"}));
  EXPECT_FALSE(held.now());
  EXPECT_FALSE(held.Read("sonar", reading));
}

TEST(HeldInstant, SensorThatIsNotUsedIsNotRequestedAgain) {
  HeldInstant held;
  Reading reading;
  held.Begin(0ms, {{"sonar", 0ms, {1}, {}}});
  EXPECT_TRUE(held.End().sensors.empty());
}

TEST(HeldInstant, NewestCommandIsSentWithTheNextWait) {
  HeldInstant held;
  EXPECT_FALSE(held.Delay({1, 0, 0}));
  held.Begin(0ms, {});
  EXPECT_TRUE(held.Delay({1, 0, 0}));
  EXPECT_TRUE(held.Delay({2, 0, 0}));
  const HeldInstant::Wait wait = held.End();
  ASSERT_TRUE(wait.command);
  EXPECT_EQ(wait.command->linear, 2);
  EXPECT_FALSE(held.Delay({3, 0, 0}));
  EXPECT_FALSE(held.End().command);
}

TEST(HeldInstant, CommandThatIsNotFiniteIsSentAtOnce) {
  HeldInstant held;
  held.Begin(0ms, {});
  EXPECT_FALSE(held.Delay({std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  EXPECT_FALSE(held.Delay({0, 0, std::numeric_limits<double>::infinity()}));
  EXPECT_FALSE(held.TakeCommand());
}

}  // namespace
}  // namespace gsv::sdk
