// Transfers bytes over a connected socket, without encryption or by TLS (tls_channel.h).
//
// Threads  any; one thread may receive while another one sends.
#pragma once

#include <chrono>
#include <cstddef>

#include <sys/types.h>

#include <omnithread.h>

namespace gsv::orb {

class Channel {
 public:
  virtual ~Channel() = default;

  // These work like recv() and send() with MSG_DONTWAIT, except that they never return 0. If no
  // bytes can be transferred now, they return -1 with EAGAIN.
  virtual ssize_t TryReceive(void* buffer, std::size_t size) = 0;
  virtual ssize_t TrySend(const void* buffer, std::size_t size) = 0;
  // These work like the functions of omniORB's connections. They return the number of bytes, 0
  // after `deadline`, or -1 if the connection has ended. A deadline of zero means no deadline.
  virtual int Receive(void* buffer, std::size_t size, const omni_time_t& deadline) = 0;
  virtual int Send(const void* buffer, std::size_t size, const omni_time_t& deadline) = 0;
  // Whether there are received bytes that the channel has already read from the socket. For such
  // bytes, poll() does not report the socket as readable.
  virtual bool HasBytes() { return false; }
  // Notifies the peer that no more bytes follow, if the protocol supports that.
  virtual void Close() {}
};

// Transfers bytes without encryption. The caller keeps the ownership of the socket.
//
// If the previous Receive() took less than 50 µs, Receive() first polls the socket for at most 50
// µs, and yields the processor between two polls. If no bytes have arrived by then, the thread
// sleeps. So behaviours that make many short calls avoid two context switches per call (ADR 101).
class PlainChannel final : public Channel {
 public:
  explicit PlainChannel(int socket) : socket_(socket) {}

  ssize_t TryReceive(void* buffer, std::size_t size) override;
  ssize_t TrySend(const void* buffer, std::size_t size) override;
  int Receive(void* buffer, std::size_t size, const omni_time_t& deadline) override;
  int Send(const void* buffer, std::size_t size, const omni_time_t& deadline) override;

 private:
  // Polls without sleeping. Returns the same values as Receive(), and 0 after `until`.
  int PollForBytes(void* buffer, std::size_t size, std::chrono::steady_clock::time_point until);
  // Waits in poll(). Returns the same values as Receive().
  int SleepForBytes(void* buffer, std::size_t size, const omni_time_t& deadline);

  const int socket_;
  // Whether the previous Receive() took less than 50 µs. If so, the next one polls before it sleeps.
  // Only the receiving thread uses this flag.
  bool last_wait_was_short_ = false;
};

// Waits until poll() reports `events`. Returns 1 if poll() reports them, or after a signal; 0 after
// `deadline`; -1 if poll() failed.
int AwaitSocket(int socket, short events, const omni_time_t& deadline);

}  // namespace gsv::orb
