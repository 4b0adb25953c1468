#include "gsv/broker/trader/liveness_monitor.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace gsv::broker {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;

// Services with prescribed answers. They count the calls.
class Services {
 public:
  Liveness Ask(const std::string& reference) {
    std::unique_lock lock(mutex_);
    ++asked_[reference];
    most_underway_ = std::max(most_underway_, ++underway_);
    changed_.notify_all();
    // No call returns before `wait_for_` calls were in progress at the same time. So
    // `most_underway_` reaches this number, and becomes larger if the monitor makes too many calls.
    changed_.wait(lock, [this] { return most_underway_ >= wait_for_; });
    --underway_;
    const auto found = pulses_.find(reference);
    return found != pulses_.end() ? found->second : Liveness::kAlive;
  }
  void SetAnswer(const std::string& reference, Liveness pulse) {
    const std::lock_guard lock(mutex_);
    pulses_[reference] = pulse;
  }
  void WaitForUnderway(int count) { wait_for_ = count; }
  void AwaitAsked(const std::string& reference, int times) {
    std::unique_lock lock(mutex_);
    const int until = asked_[reference] + times;
    changed_.wait(lock, [&] { return asked_[reference] >= until; });
  }
  int Asked(const std::string& reference) {
    const std::lock_guard lock(mutex_);
    return asked_[reference];
  }
  int most_underway() {
    const std::lock_guard lock(mutex_);
    return most_underway_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, int> asked_;
  std::map<std::string, Liveness> pulses_;
  int underway_ = 0;
  int most_underway_ = 0;
  int wait_for_ = 0;
};

// Returns "IOR:" and the digits of a reference to `object` at `port` of 127.0.0.1.
std::string Reference(int port, char object) {
  std::string bytes(4, '\1');                             // byte order (little endian) and padding
  bytes += std::string("\1\0\0\0\0\0\0\0", 8);            // an empty type id
  bytes += std::string("\1\0\0\0\0\0\0\0\40\0\0\0", 12);  // one IIOP profile of 32 bytes
  bytes += std::string("\1\1\2\0\12\0\0\0", 8) + "127.0.0.1" + '\0';
  bytes += static_cast<char>(port & 0xff);
  bytes += static_cast<char>(port >> 8);
  bytes += std::string("\1\0\0\0", 4) + object + std::string(7, '\0');
  std::string text = "IOR:";
  for (const char byte : bytes) {
    constexpr const char* kDigits = "0123456789abcdef";
    text += kDigits[static_cast<unsigned char>(byte) >> 4];
    text += kDigits[static_cast<unsigned char>(byte) & 15];
  }
  return text;
}

class LivenessMonitorTest : public testing::Test {
 protected:
  LivenessMonitorTest() { EXPECT_TRUE(trader_.AddType({.name = "Robot"})); }

  void Start(milliseconds max_silence) {
    monitor_.emplace(
        LivenessOptions{.period = milliseconds(1), .max_silence = max_silence, .concurrent = 3},
        trader_,
        [this](const std::string& reference, milliseconds) { return services_.Ask(reference); });
  }
  void AwaitOffers(std::size_t count) {
    while (trader_.OfferIds().size() != count) std::this_thread::yield();
  }

  Trader trader_{TraderLimits{}, 1, 1};
  Services services_;
  std::optional<LivenessMonitor> monitor_;
};

TEST_F(LivenessMonitorTest, WithdrawsEveryOfferOfADeadService) {
  const std::string other = *trader_.Export("Robot", "IOR:01", {});
  ASSERT_TRUE(trader_.Export("Robot", "IOR:02", {}));
  ASSERT_TRUE(trader_.Export("Robot", "IOR:02", {}));
  Start(hours(1));
  services_.AwaitAsked("IOR:02", 3);
  EXPECT_EQ(trader_.OfferIds().size(), 3u);
  services_.SetAnswer("IOR:02", Liveness::kGone);
  AwaitOffers(1);
  EXPECT_EQ(trader_.OfferIds(), std::vector<std::string>{other});
  services_.AwaitAsked("IOR:01", 3);
}

TEST_F(LivenessMonitorTest, ServiceIsDeadOnlyAfterTheMaximumSilence) {
  ASSERT_TRUE(trader_.Export("Robot", "IOR:01", {}));
  services_.SetAnswer("IOR:01", Liveness::kSilent);
  Start(hours(1));
  services_.AwaitAsked("IOR:01", 20);
  EXPECT_EQ(trader_.OfferIds().size(), 1u);
  monitor_.reset();
  Start(milliseconds(0));
  AwaitOffers(0);
}

// The two references have the same address, so the monitor must call only one of them per period. A
// monitor that called both services would call them equally often.
TEST_F(LivenessMonitorTest, CallsASilentAddressOncePerPeriod) {
  const std::string first = Reference(4321, 'a');
  const std::string second = Reference(4321, 'b');
  const std::string elsewhere = Reference(4322, 'a');
  for (const std::string& reference : {first, second, elsewhere}) {
    ASSERT_TRUE(trader_.Export("Robot", reference, {}));
    services_.SetAnswer(reference, Liveness::kSilent);
  }
  services_.SetAnswer(elsewhere, Liveness::kAlive);
  monitor_.emplace(
      LivenessOptions{.period = milliseconds(1), .max_silence = hours(1), .concurrent = 1}, trader_,
      [this](const std::string& reference, milliseconds) { return services_.Ask(reference); });
  services_.AwaitAsked(elsewhere, 10);
  monitor_.reset();
  EXPECT_GE(services_.Asked(first), 9);
  EXPECT_EQ(services_.Asked(second), 0);
}

TEST_F(LivenessMonitorTest, LimitsConcurrentCalls) {
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(trader_.Export("Robot", "IOR:" + std::to_string(i), {}));
  }
  services_.WaitForUnderway(3);
  Start(hours(1));
  services_.AwaitAsked("IOR:49", 2);
  monitor_.reset();
  EXPECT_EQ(services_.most_underway(), 3);
}

}  // namespace
}  // namespace gsv::broker
