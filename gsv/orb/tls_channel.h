// TLS over one connection. Both ends show a certificate of the same authority, or it fails.
//
// Versions 1.2 and 1.3 (RFC 5246, RFC 8446), without resumption and renegotiation: every
//          connection is a handshake of its own. The host's name is not compared with the
//          certificate's: of those whom the authority has signed, each may be any.
// Threads  any; one may read while another writes, which OpenSSL alone does not allow.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>

#include <omnithread.h>

#include "gsv/base/error.h"
#include "gsv/orb/corba_access.h"

struct ssl_st;
struct ssl_ctx_st;

namespace gsv::orb {

class TlsContext {
 public:
  // Fails with a sentence that names the file which cannot be used.
  static base::Result<std::shared_ptr<const TlsContext>> Read(const CorbaCertificate& files);
  ~TlsContext();
  TlsContext(const TlsContext&) = delete;
  TlsContext& operator=(const TlsContext&) = delete;

  ssl_ctx_st* get() const { return context_; }

 private:
  explicit TlsContext(ssl_ctx_st* context) : context_(context) {}
  ssl_ctx_st* context_;
};

class TlsChannel {
 public:
  enum class Side { kServer, kClient };
  enum class Step { kDone, kWantsToRead, kWantsToWrite, kFailed };

  // The socket remains the caller's; it no longer blocks.
  TlsChannel(std::shared_ptr<const TlsContext> context, int socket, Side side);
  ~TlsChannel();
  TlsChannel(const TlsChannel&) = delete;
  TlsChannel& operator=(const TlsChannel&) = delete;

  // As far as it goes without waiting.
  Step Handshake();
  // Whether it was done before `deadline`.
  bool AwaitHandshake(const omni_time_t& deadline, bool& timed_out);
  // Why it failed, as a sentence about the peer: "it shows no certificate".
  const std::string& failure() const { return failure_; }

  // As recv() and send() with MSG_DONTWAIT: -1 with EAGAIN when nothing moves now.
  ssize_t TryReceive(void* buffer, std::size_t size);
  ssize_t TrySend(const void* buffer, std::size_t size);
  // As omniORB's connections: the bytes moved, 0 when it is too late, -1 when it is over.
  int Receive(void* buffer, std::size_t size, const omni_time_t& deadline);
  int Send(const void* buffer, std::size_t size, const omni_time_t& deadline);

  // Whether bytes have come that are not handed out yet.
  bool HasBytes();
  void Close();

 private:
  Step StepAfter(int result);
  template <typename Call>
  Step Try(const Call& call, std::size_t& moved);
  template <typename Call>
  int Await(const Call& call, const omni_time_t& deadline);

  const std::shared_ptr<const TlsContext> context_;
  const int socket_;
  std::mutex mutex_;
  ssl_st* session_;
  std::string failure_;
};

// Why the last TLS connection that this thread asked for failed, once; empty: it did not.
std::string TakeTlsFailure();
void NoteTlsFailure(std::string why);

}  // namespace gsv::orb
