#include "gsv/orb/transport/channel.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <climits>

namespace gsv::orb {
namespace {

bool IsInterrupted() { return errno == EINTR || errno == EAGAIN || errno == EWOULDBLOCK; }

}  // namespace

int AwaitSocket(int socket, short events, const omni_time_t& deadline) {
  int milliseconds = -1;
  if (deadline) {
    omni_time_t now;
    omni_thread::get_time(now);
    if (deadline <= now) return 0;
    const omni_time_t left = deadline - now;
    milliseconds =
        static_cast<int>(std::min<long>(left.s, 1'000'000) * 1000 + left.ns / 1'000'000) + 1;
  }
  pollfd descriptor{socket, events, 0};
  const int count = poll(&descriptor, 1, milliseconds);
  if (count < 0) return errno == EINTR ? 1 : -1;
  return count;  // an error is reported by the next read or write
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
  for (bool polls = static_cast<bool>(deadline);; polls = true) {
    if (polls) {
      const int ready = AwaitSocket(socket_, POLLOUT, deadline);
      if (ready <= 0) return ready;
    }
    const ssize_t sent = send(socket_, buffer, size, MSG_NOSIGNAL | (polls ? MSG_DONTWAIT : 0));
    if (sent > 0) return static_cast<int>(sent);
    if (sent == 0 || !IsInterrupted()) return -1;
  }
}

}  // namespace gsv::orb
