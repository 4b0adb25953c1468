#include "gsv/orb/transport/channel.h"

#include <poll.h>
#include <sched.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <climits>

namespace gsv::orb {
namespace {

using Clock = std::chrono::steady_clock;

// If the last wait was shorter than this limit, the next wait polls the socket for this long before
// the thread sleeps. Falling asleep and waking up take 10 to 20 µs. Most answers to a behaviour's
// calls arrive within this limit.
constexpr std::chrono::microseconds kShortWait{50};

// Returns the time that is left, rounded up; 0 after the deadline; -1 if there is no deadline.
int MillisecondsUntil(const omni_time_t& deadline) {
  if (!deadline) return -1;
  omni_time_t now;
  omni_thread::get_time(now);
  if (deadline <= now) return 0;
  const omni_time_t left = deadline - now;
  return static_cast<int>(std::min<long>(left.s, 1'000'000) * 1000 + left.ns / 1'000'000) + 1;
}

bool IsInterrupted() { return errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK; }

}  // namespace

int AwaitSocket(int socket, short events, const omni_time_t& deadline) {
  const int milliseconds = MillisecondsUntil(deadline);
  if (milliseconds == 0) return 0;
  pollfd descriptor{socket, events, 0};
  const int count = poll(&descriptor, 1, milliseconds);
  if (count < 0) return errno == EINTR ? 1 : -1;
  return count;  // 1 also after an error of the socket, which the next read or write returns
}

ssize_t PlainChannel::TryReceive(void* buffer, std::size_t size) {
  const ssize_t received = recv(socket_, buffer, size, MSG_DONTWAIT);
  if (received != 0) return received;
  errno = ECONNRESET;
  return -1;
}

ssize_t PlainChannel::TrySend(const void* buffer, std::size_t size) {
  return send(socket_, buffer, size, MSG_DONTWAIT | MSG_NOSIGNAL);
}

int PlainChannel::Receive(void* buffer, std::size_t size, const omni_time_t& deadline) {
  size = std::min<std::size_t>(size, INT_MAX);
  const auto start = Clock::now();
  int received = last_wait_was_short_ ? PollForBytes(buffer, size, start + kShortWait) : 0;
  if (received == 0) received = SleepForBytes(buffer, size, deadline);
  last_wait_was_short_ = Clock::now() - start < kShortWait;
  return received;
}

int PlainChannel::PollForBytes(void* buffer, std::size_t size, Clock::time_point until) {
  do {
    const ssize_t received = TryReceive(buffer, size);
    if (received > 0) return static_cast<int>(received);
    if (!IsInterrupted()) return -1;
    sched_yield();  // yields to the peer, if it shares the processor
  } while (Clock::now() < until);
  return 0;
}

int PlainChannel::SleepForBytes(void* buffer, std::size_t size, const omni_time_t& deadline) {
  for (bool polls = static_cast<bool>(deadline);; polls = true) {
    if (polls) {
      const int ready = AwaitSocket(socket_, POLLIN, deadline);
      if (ready <= 0) return ready;
    }
    const ssize_t received = recv(socket_, buffer, size, polls ? MSG_DONTWAIT : 0);
    if (received > 0) return static_cast<int>(received);
    if (received == 0 || !IsInterrupted()) return -1;
  }
}

int PlainChannel::Send(const void* buffer, std::size_t size, const omni_time_t& deadline) {
  size = std::min<std::size_t>(size, INT_MAX);
  for (;;) {
    if (MillisecondsUntil(deadline) == 0) return 0;
    const ssize_t sent = send(socket_, buffer, size, MSG_NOSIGNAL | (deadline ? MSG_DONTWAIT : 0));
    if (sent > 0) return static_cast<int>(sent);
    if (sent == 0 || !IsInterrupted()) return -1;
    const int ready = AwaitSocket(socket_, POLLOUT, deadline);
    if (ready <= 0) return ready;
  }
}

}  // namespace gsv::orb
