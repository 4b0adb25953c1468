#include "gsv/orb/transport/channel.h"

#include <array>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

namespace gsv::orb {
namespace {

omni_time_t AfterSeconds(long seconds) {
  omni_time_t time;
  omni_thread::get_time(time, omni_time_t(seconds, 0));
  return time;
}

std::array<int, 2> ConnectedSockets() {
  std::array<int, 2> ends{};
  EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
  return ends;
}

class PlainChannelTest : public ::testing::Test {
 public:
  ~PlainChannelTest() override {
    for (const int end : ends_) close(end);
  }

 protected:
  // Receives bytes that have already arrived, so that each Receive() is short. After a short
  // Receive(), the next one polls the socket before it sleeps.
  void MakeLastWaitShort() {
    for (int i = 0; i < 100; ++i) {
      peer_.Send("x", 1, {});
      std::array<char, 8> buffer{};
      ASSERT_EQ(channel_.Receive(buffer.data(), buffer.size(), AfterSeconds(60)), 1);
    }
  }

  std::array<int, 2> ends_ = ConnectedSockets();
  PlainChannel channel_{ends_[0]}, peer_{ends_[1]};
  std::array<char, 8> buffer_{};
};

TEST_F(PlainChannelTest, AnswersManyShortCalls) {
  constexpr int kCalls = 2000;
  std::thread server([this] {
    std::array<char, 8> request{};
    while (peer_.Receive(request.data(), request.size(), {}) == 4) peer_.Send("pong", 4, {});
  });
  for (int i = 0; i < kCalls; ++i) {
    ASSERT_EQ(channel_.Send("ping", 4, AfterSeconds(60)), 4);
    ASSERT_EQ(channel_.Receive(buffer_.data(), buffer_.size(), AfterSeconds(60)), 4);
    ASSERT_EQ(std::string(buffer_.data(), 4), "pong");
  }
  shutdown(ends_[0], SHUT_WR);
  server.join();
}

TEST_F(PlainChannelTest, SilentPeerEndsAtTheDeadlineAfterShortWaits) {
  MakeLastWaitShort();
  omni_time_t soon;
  omni_thread::get_time(soon, omni_time_t(0, 1'000'000));
  EXPECT_EQ(channel_.Receive(buffer_.data(), buffer_.size(), soon), 0);
}

TEST_F(PlainChannelTest, ClosedPeerIsSeenWhilePollingAndWhileSleeping) {
  MakeLastWaitShort();
  shutdown(ends_[1], SHUT_RDWR);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(channel_.Receive(buffer_.data(), buffer_.size(), AfterSeconds(60)), -1);
  }
}

TEST_F(PlainChannelTest, ShutdownOfTheOwnEndWakesTheReceiver) {
  MakeLastWaitShort();
  std::thread receiver(
      [this] { EXPECT_EQ(channel_.Receive(buffer_.data(), buffer_.size(), {}), -1); });
  shutdown(ends_[0], SHUT_RDWR);
  receiver.join();
}

TEST_F(PlainChannelTest, SendsNothingAfterTheDeadline) {
  EXPECT_EQ(channel_.Send("late", 4, AfterSeconds(-1)), 0);
  EXPECT_EQ(peer_.TryReceive(buffer_.data(), buffer_.size()), -1);
  EXPECT_EQ(errno, EAGAIN);
}

TEST_F(PlainChannelTest, SendWaitsForSpaceUntilTheDeadline) {
  const std::string much(1 << 20, 'x');
  while (channel_.TrySend(much.data(), much.size()) > 0) {
  }
  omni_time_t soon;
  omni_thread::get_time(soon, omni_time_t(0, 1'000'000));
  EXPECT_EQ(channel_.Send("more", 4, soon), 0);
  std::thread reader([this] {
    std::string bytes(1 << 20, '\0');
    while (peer_.TryReceive(bytes.data(), bytes.size()) > 0) {
    }
  });
  EXPECT_GT(channel_.Send("more", 4, AfterSeconds(60)), 0);
  reader.join();
}

}  // namespace
}  // namespace gsv::orb
