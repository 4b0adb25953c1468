#include "gsv/gateway/server/send_window.h"

#include <algorithm>
#include <deque>
#include <utility>

#include <gtest/gtest.h>

namespace gsv::gateway {
namespace {

using std::chrono::milliseconds;
using Time = SendWindow::Time;

constexpr milliseconds kMessagePeriod{10}, kStep{1};

// Simulates a connection with a rate in bytes per second, a delay and an unlimited buffer. The
// sender has a message every kMessagePeriod, and drops the message if the window is closed.
class Link {
 public:
  Link(double rate, milliseconds delay, std::size_t message)
      : rate_(rate), delay_(delay), message_(message) {}

  void set_rate(double rate) { rate_ = rate; }
  void set_delay(milliseconds delay) { delay_ = delay; }

  // Runs the connection for `duration`. Returns the longest time from the sending of a message to
  // its arrival.
  std::chrono::duration<double> Run(milliseconds duration) {
    std::chrono::duration<double> longest{0};
    for (const Time end = now_ + duration; now_ < end; now_ += kStep) {
      if (now_.time_since_epoch() % kMessagePeriod == milliseconds(0)) Offer();
      for (double passes = rate_ * std::chrono::duration<double>(kStep).count();
           !buffered_.empty() && passes > 0;) {
        const double part = std::min(passes, buffered_.front().bytes);
        passes -= part;
        buffered_.front().bytes -= part;
        if (buffered_.front().bytes > 0) break;
        if (buffered_.front().ping == 0) {
          ++received_;
          longest = std::max<std::chrono::duration<double>>(
              longest, now_ + delay_ / 2 - buffered_.front().sent);
        } else {
          pongs_.push_back({now_ + delay_, buffered_.front().ping});
        }
        buffered_.pop_front();
      }
      while (!pongs_.empty() && pongs_.front().first <= now_) {
        window_.Pong(pongs_.front().second, now_);
        pongs_.pop_front();
        is_slow_ = window_.IsSlow(now_);
        PingIfWanted();
      }
    }
    return longest;
  }

  int TakeReceived() { return std::exchange(received_, 0); }
  bool is_slow() const { return is_slow_; }
  const SendWindow& window() const { return window_; }

 private:
  struct Buffered {
    double bytes = 0;
    std::uint64_t ping = 0;  // 0: a message
    Time sent;
  };

  void Offer() {
    if (!window_.is_open()) {
      window_.HoldBack();
      window_.LeftOut(now_);
      return;
    }
    buffered_.push_back({static_cast<double>(message_), 0, now_});
    window_.Sent(message_, true, now_);
    PingIfWanted();
  }

  void PingIfWanted() {
    if (window_.WantsPing(now_)) buffered_.push_back({8, window_.Ping(now_, now_), now_});
  }

  double rate_;
  milliseconds delay_;
  std::size_t message_;
  Time now_{std::chrono::seconds(100)};
  SendWindow window_;
  std::deque<Buffered> buffered_;
  std::deque<std::pair<Time, std::uint64_t>> pongs_;
  int received_ = 0;
  bool is_slow_ = false;
};

TEST(SendWindow, SendsAllMessagesOnAFastConnection) {
  Link link(10e6, milliseconds(1), 10'000);  // the sender produces 1 MB/s
  link.Run(milliseconds(1000));
  link.TakeReceived();
  link.Run(milliseconds(10'000));
  EXPECT_GE(link.TakeReceived(), 999);
  EXPECT_FALSE(link.is_slow());
  EXPECT_FALSE(link.window().slow_rate());
}

TEST(SendWindow, GrowsUntilItFillsAConnectionWithALongDelay) {
  Link link(10e6, milliseconds(280), 10'000);
  link.Run(milliseconds(10'000));
  link.TakeReceived();
  link.Run(milliseconds(10'000));
  EXPECT_GE(link.TakeReceived(), 990);
}

TEST(SendWindow, BoundsTheDelayOfASlowConnectionAndUsesItsRate) {
  Link link(25'000, milliseconds(20), 1'000);            // the sender produces 100 kB/s
  EXPECT_LT(link.Run(milliseconds(2000)).count(), 0.8);  // the window is too large at the start
  link.TakeReceived();
  EXPECT_LT(link.Run(milliseconds(10'000)).count(), 0.5);
  EXPECT_GE(link.TakeReceived(), 225);  // the link transfers 250 messages
  EXPECT_TRUE(link.is_slow());
  ASSERT_TRUE(link.window().slow_rate());
  EXPECT_NEAR(*link.window().slow_rate(), 25'000, 8'000);
}

TEST(SendWindow, FollowsAConnectionThatBecomesSlowAndFastAgain) {
  Link link(10e6, milliseconds(1), 5'000);  // the sender produces 500 kB/s
  link.Run(milliseconds(5000));
  link.set_rate(50'000);
  link.Run(milliseconds(10'000));
  EXPECT_LT(link.Run(milliseconds(5000)).count(), 0.5);
  EXPECT_TRUE(link.is_slow());
  link.set_rate(10e6);
  link.Run(milliseconds(10'000));
  link.TakeReceived();
  link.Run(milliseconds(1000));
  EXPECT_GE(link.TakeReceived(), 99);
  EXPECT_FALSE(link.is_slow());
}

TEST(SendWindow, AConnectionWhoseDelayIncreasesIsNotSlowForever) {
  for (const milliseconds delay : {milliseconds(450), milliseconds(1200)}) {
    Link link(10e6, milliseconds(20), 5'000);  // the sender produces 500 kB/s
    link.Run(milliseconds(10'000));
    link.set_delay(delay);
    link.Run(milliseconds(10'000));
    EXPECT_TRUE(link.is_slow());
    link.Run(milliseconds(60'000));
    EXPECT_FALSE(link.is_slow());
    link.TakeReceived();
    link.Run(milliseconds(10'000));
    EXPECT_GE(link.TakeReceived(), 990);
    link.set_delay(milliseconds(20));
    link.set_rate(50'000);
    link.Run(milliseconds(60'000));
    EXPECT_LT(link.Run(milliseconds(5000)).count(), 0.6) << "the minimum delay became short again";
    EXPECT_TRUE(link.is_slow());
  }
}

TEST(SendWindow, AConnectionOfALowRateStaysSlowWhenTheMinimumDelayIsMeasuredAgain) {
  Link link(25'000, milliseconds(20), 1'000);  // the sender produces 100 kB/s
  link.Run(milliseconds(5000));
  for (int i = 0; i < 10; ++i) {
    EXPECT_LT(link.Run(milliseconds(20'000)).count(), 0.6);
    EXPECT_TRUE(link.is_slow());
    EXPECT_GE(link.TakeReceived(), 440);  // the link transfers 500 messages
  }
}

TEST(SendWindow, SendsOneMessageOfAnySizeAtATime) {
  SendWindow window;
  EXPECT_TRUE(window.is_open());
  window.Sent(10 * SendWindow::kMaxBytes, true, Time{});
  EXPECT_FALSE(window.is_open());
  ASSERT_TRUE(window.WantsPing(Time{}));
  const std::uint64_t number = window.Ping(Time{}, Time{});
  window.Pong(number + 1, Time{});  // a pong of another ping
  EXPECT_FALSE(window.is_open());
  window.Pong(number, Time{});
  EXPECT_TRUE(window.is_open());
}

TEST(SendWindow, WantsAnotherPingIfMessagesFollowedTheFirst) {
  SendWindow window;
  window.Sent(100, true, Time{});
  const std::uint64_t number = window.Ping(Time{}, Time{});
  window.Sent(SendWindow::kFirstBytes, true, Time{});
  EXPECT_FALSE(window.WantsPing(Time{}));
  window.Pong(number, Time{});
  EXPECT_FALSE(window.is_open());
  EXPECT_TRUE(window.WantsPing(Time{}));
}

TEST(SendWindow, ControlMessagesDoNotCloseTheWindow) {
  SendWindow window;
  window.Sent(SendWindow::kMaxBytes, false, Time{});
  EXPECT_TRUE(window.is_open());
}

TEST(SendWindow, ConnectionIsSlowIfAllPongsAreLate) {
  SendWindow window;
  Time now{std::chrono::seconds(100)};
  for (int i = 0; i < 3; ++i) {
    window.Sent(SendWindow::kMinBytes, true, now);
    const std::uint64_t number = window.Ping(now, now);
    now += 2 * SendWindow::kInTimeAfter;
    if (i == 2) {
      EXPECT_TRUE(window.IsSlow(now)) << "while a pong is overdue";
    }
    window.Pong(number, now);
  }
  EXPECT_TRUE(window.IsSlow(now));
  ASSERT_TRUE(window.slow_rate());
  EXPECT_NEAR(*window.slow_rate(), SendWindow::kMinBytes / 10.0, 100);
}

TEST(SendWindow, APongWithoutANumberOpensTheWindow) {
  SendWindow window;
  window.Sent(SendWindow::kMaxBytes, true, Time{});
  window.Ping(Time{}, Time{});
  EXPECT_FALSE(window.is_open());
  window.PongOfAny(Time{});
  EXPECT_TRUE(window.is_open());
}

TEST(SendWindow, OneLatePongDoesNotMakeAConnectionSlow) {
  SendWindow window;
  window.Sent(100, true, Time{});
  const std::uint64_t number = window.Ping(Time{}, Time{});
  window.Pong(number, Time{std::chrono::seconds(30)});
  EXPECT_FALSE(window.IsSlow(Time{std::chrono::seconds(30)}));
}

}  // namespace
}  // namespace gsv::gateway
