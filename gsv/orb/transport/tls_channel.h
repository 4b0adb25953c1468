// TLS over one connection. Both peers must show a certificate of the same authority; otherwise the
// handshake fails.
//
// Protocol TLS 1.2 and 1.3 (RFC 5246, RFC 8446), without resumption and renegotiation: every
//          connection has a full handshake. The host name in the certificate is not checked: any
//          certificate of the authority is accepted for any host.
// Threads  any; one thread may read while another one writes, which OpenSSL alone does not allow.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <omnithread.h>

#include "gsv/base/mutex.h"
#include "gsv/orb/transport/channel.h"
#include "gsv/orb/transport/tls_context.h"

struct ssl_st;

namespace gsv::orb {

class TlsChannel final : public Channel {
 public:
  // The role of this process in the handshake.
  enum class Side { kServer, kClient };
  // The result of a call to OpenSSL. kWantsToRead and kWantsToWrite: the call must be repeated when
  // the socket is readable or writable.
  enum class Step { kDone, kWantsToRead, kWantsToWrite, kFailed };

  // The caller keeps the ownership of the socket, which becomes non-blocking.
  TlsChannel(std::shared_ptr<const TlsContext> context, int socket, Side side);
  ~TlsChannel() override;
  TlsChannel(const TlsChannel&) = delete;
  TlsChannel& operator=(const TlsChannel&) = delete;

  // Continues the handshake as far as possible without waiting.
  Step Handshake();
  // Waits for the handshake. Returns whether it was completed before `deadline`.
  bool AwaitHandshake(const omni_time_t& deadline, bool& timed_out);
  // The reason of the failure, as a clause about the peer, such as "it sends no certificate".
  std::string failure() const;

  ssize_t TryReceive(void* buffer, std::size_t size) override;
  ssize_t TrySend(const void* buffer, std::size_t size) override;
  int Receive(void* buffer, std::size_t size, const omni_time_t& deadline) override;
  int Send(const void* buffer, std::size_t size, const omni_time_t& deadline) override;
  bool HasBytes() override;
  void Close() override;

 private:
  // Converts the result of a call to OpenSSL, and sets failure_ if it has failed.
  Step StepAfter(int result) GSV_REQUIRES(mutex_);
  // Makes a call to OpenSSL once. Sets `moved` to the number of bytes that were read or written.
  template <typename Call>
  Step Try(const Call& call, std::size_t& moved);
  // Repeats a call to OpenSSL until it is done. Returns the same values as Channel::Receive().
  template <typename Call>
  int Await(const Call& call, const omni_time_t& deadline);

  const std::shared_ptr<const TlsContext> context_;
  const int socket_;
  mutable base::Mutex mutex_;
  // Null if OpenSSL could not create a session.
  ssl_st* const session_ GSV_PT_GUARDED_BY(mutex_);
  // the clause of failure(); empty if nothing has failed
  std::string failure_ GSV_GUARDED_BY(mutex_);
};

// Returns the reason why the last TLS connection that this thread requested has failed, and deletes
// the stored reason. Returns an empty text if that connection has not failed.
std::string TakeTlsFailure();
// Stores the reason of a failure for TakeTlsFailure() on this thread.
void NoteTlsFailure(std::string why);

}  // namespace gsv::orb
