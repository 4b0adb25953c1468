// Moves bytes over a connected socket, as they are or by TLS (tls_channel.h).
//
// Threads  any; one may receive while another sends.
#pragma once

#include <cstddef>

#include <sys/types.h>

#include <omnithread.h>

namespace gsv::orb {

class Channel {
 public:
  virtual ~Channel() = default;

  // As recv() and send() with MSG_DONTWAIT, but never 0: -1 with EAGAIN when nothing moves now.
  virtual ssize_t TryReceive(void* buffer, std::size_t size) = 0;
  virtual ssize_t TrySend(const void* buffer, std::size_t size) = 0;
  // As omniORB's connections: the bytes moved, 0 after `deadline`, -1 when the connection is over.
  // A deadline of zero is none.
  virtual int Receive(void* buffer, std::size_t size, const omni_time_t& deadline) = 0;
  virtual int Send(const void* buffer, std::size_t size, const omni_time_t& deadline) = 0;
  // Whether bytes have come that poll() does not know of.
  virtual bool HasBytes() { return false; }
  // Tells the peer that no more bytes follow, where the protocol can.
  virtual void Close() {}
};

// Bytes as they are. The socket remains the caller's.
class PlainChannel final : public Channel {
 public:
  explicit PlainChannel(int socket) : socket_(socket) {}

  ssize_t TryReceive(void* buffer, std::size_t size) override;
  ssize_t TrySend(const void* buffer, std::size_t size) override;
  int Receive(void* buffer, std::size_t size, const omni_time_t& deadline) override;
  int Send(const void* buffer, std::size_t size, const omni_time_t& deadline) override;

 private:
  const int socket_;
};

// Waits until poll() reports `events`. 1: it does, or a signal came; 0: after `deadline`; -1: it
// failed.
int AwaitSocket(int socket, short events, const omni_time_t& deadline);

}  // namespace gsv::orb
