#include "gsv/gateway/api/command_timeouts.h"

#include <future>

#include <gtest/gtest.h>

namespace gsv::gateway {
namespace {

using namespace std::chrono_literals;

class CommandTimeoutsTest : public ::testing::Test {
 protected:
  // Returns a function that reports `name` when a timeout runs it.
  std::function<void()> Report(const std::string& name) {
    return [this, name] { reported_.set_value(name); };
  }
  std::string Reported() { return reported_.get_future().get(); }

  std::promise<std::string> reported_;
  CommandTimeouts timeouts_;
};

TEST_F(CommandTimeoutsTest, RunsAFunctionAfterItsTime) {
  const auto begin = std::chrono::steady_clock::now();
  timeouts_.Set("pebble", 20ms, Report("pebble"));
  EXPECT_EQ(Reported(), "pebble");
  EXPECT_GE(std::chrono::steady_clock::now() - begin, 20ms);
}

TEST_F(CommandTimeoutsTest, ALaterTimeoutReplacesAnEarlierOne) {
  timeouts_.Set("pebble", 1ms, [] {});
  timeouts_.Set("pebble", 1h, Report("never"));
  timeouts_.Set("pebble", 1ms, Report("last"));
  EXPECT_EQ(Reported(), "last");
}

TEST_F(CommandTimeoutsTest, ACancelledTimeoutDoesNotRun) {
  timeouts_.Set("pebble", 1h, Report("pebble"));
  timeouts_.Cancel("pebble");
  timeouts_.Set("marble", 1ms, Report("marble"));
  EXPECT_EQ(Reported(), "marble");
}

}  // namespace
}  // namespace gsv::gateway
