#include "apps/gsv/serving/server_limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gsv::app {
namespace {

using ::testing::HasSubstr;

std::string Refusal(const std::string& text) {
  ServerLimits limits;
  const auto set = SetServerLimit(text, limits);
  return set ? "taken" : set.error().Sentence();
}

TEST(ServerLimits, EachNameCanBeSet) {
  std::string names = ServerLimitNames() + ", ";
  int count = 0;
  for (std::size_t comma; (comma = names.find(", ")) != std::string::npos; ++count) {
    const std::string name = names.substr(0, comma);
    EXPECT_TRUE(IsServerLimit(name)) << name;
    EXPECT_EQ(Refusal(name + "=1"), "taken");
    names.erase(0, comma + 2);
  }
  EXPECT_GE(count, 15);
  EXPECT_FALSE(IsServerLimit("robot"));
  EXPECT_FALSE(IsServerLimit(""));
}

TEST(ServerLimits, SetTheLimitsOfTheServer) {
  ServerLimits limits;
  for (const char* text : {"robots=500", "connections=7", "reading_seconds=3", "upload_bytes=9"})
    ASSERT_TRUE(SetServerLimit(text, limits)) << text;
  EXPECT_EQ(limits.simulation.robots, 500u);
  EXPECT_EQ(limits.web.connections, 7u);
  EXPECT_EQ(limits.reading.wall_time, std::chrono::seconds(3));
  EXPECT_EQ(limits.reading.sandbox.processor_time, std::chrono::seconds(3));
  EXPECT_EQ(limits.web.upload_bytes, 9u);
}

TEST(ServerLimits, RefuseInvalidAndLargeNumbers) {
  for (const char* number : {"", "0", "-1", "1.5", "1x", " 1", "1e3", "99999999999999999999"})
    EXPECT_THAT(Refusal(std::string("simulations=") + number),
                HasSubstr("simulations must be a whole number from 1 to 10000, not \""))
        << number;
  EXPECT_THAT(Refusal("simulations"), HasSubstr("not \"\""));
  EXPECT_EQ(Refusal("simulations=10000"), "taken");
  EXPECT_THAT(Refusal("simulations=10001"), HasSubstr("not \"10001\""));
}

}  // namespace
}  // namespace gsv::app
