#include "gsv/orb/transport/tls_channel.h"

#include <fcntl.h>
#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <utility>

#include <openssl/err.h>
#include <openssl/ssl.h>

namespace gsv::orb {
namespace {

thread_local std::string last_failure;

// Whether the peer's alert concerns our certificate (RFC 8446, 6.2).
bool IsAboutCertificate(int alert) {
  switch (alert) {
    case SSL_AD_BAD_CERTIFICATE:
    case SSL_AD_UNSUPPORTED_CERTIFICATE:
    case SSL_AD_CERTIFICATE_REVOKED:
    case SSL_AD_CERTIFICATE_EXPIRED:
    case SSL_AD_CERTIFICATE_UNKNOWN:
    case SSL_AD_UNKNOWN_CA:
    case TLS13_AD_CERTIFICATE_REQUIRED:
      return true;
    default:
      return false;
  }
}

// Returns the reason of the newest error in OpenSSL's queue of this thread.
std::string Reason(long verdict) {
  if (verdict == X509_V_ERR_CERT_HAS_EXPIRED) return "its certificate has expired";
  if (verdict != X509_V_OK) {
    return std::string("its certificate was not issued by this group's authority (") +
           X509_verify_cert_error_string(verdict) + ")";
  }
  const unsigned long error = ERR_peek_error();
  const char* const text = ERR_reason_error_string(error);
  const std::string detail = text != nullptr ? std::string(" (") + text + ")" : "";
  const int reason = ERR_GET_REASON(error);
  if (ERR_GET_LIB(error) != ERR_LIB_SSL || reason == SSL_R_UNEXPECTED_EOF_WHILE_READING) {
    return "it closed the connection";
  }
  if (reason == SSL_R_PEER_DID_NOT_RETURN_A_CERTIFICATE) return "it sends no certificate";
  if (reason >= SSL_AD_REASON_OFFSET) {
    return IsAboutCertificate(reason - SSL_AD_REASON_OFFSET)
               ? "it rejects this program's certificate" + detail
               : "it ended the connection" + detail;
  }
  return "it violates the TLS protocol" + detail;
}

}  // namespace

TlsChannel::TlsChannel(std::shared_ptr<const TlsContext> context, int socket, Side side)
    : context_(std::move(context)), socket_(socket), session_(SSL_new(context_->get())) {
  fcntl(socket, F_SETFL, fcntl(socket, F_GETFL) | O_NONBLOCK);
  if (session_ == nullptr) return;  // out of memory: the handshake will fail at once
  SSL_set_fd(session_, socket);
  side == Side::kServer ? SSL_set_accept_state(session_) : SSL_set_connect_state(session_);
}

TlsChannel::~TlsChannel() { SSL_free(session_); }

TlsChannel::Step TlsChannel::StepAfter(int result) {
  if (result > 0) return Step::kDone;
  switch (SSL_get_error(session_, result)) {
    case SSL_ERROR_WANT_READ:
      return Step::kWantsToRead;
    case SSL_ERROR_WANT_WRITE:
      return Step::kWantsToWrite;
    case SSL_ERROR_ZERO_RETURN:
      failure_ = "it closed the connection";
      return Step::kFailed;
    default:
      failure_ = Reason(SSL_get_verify_result(session_));
      return Step::kFailed;
  }
}

template <typename Call>
TlsChannel::Step TlsChannel::Try(const Call& call, std::size_t& moved) {
  const base::MutexLock lock(mutex_);
  moved = 0;
  if (session_ == nullptr) return Step::kFailed;
  ERR_clear_error();
  errno = 0;
  return StepAfter(call(&moved));
}

template <typename Call>
int TlsChannel::Await(const Call& call, const omni_time_t& deadline) {
  while (true) {
    std::size_t moved = 0;
    const Step step = Try(call, moved);
    if (step == Step::kDone) return static_cast<int>(moved);
    if (step == Step::kFailed) return -1;
    const int ready = AwaitSocket(socket_, step == Step::kWantsToRead ? POLLIN : POLLOUT, deadline);
    if (ready <= 0) return ready;
  }
}

TlsChannel::Step TlsChannel::Handshake() {
  std::size_t ignored = 0;
  return Try([this](std::size_t*) { return SSL_do_handshake(session_); }, ignored);
}

bool TlsChannel::AwaitHandshake(const omni_time_t& deadline, bool& timed_out) {
  last_failure.clear();
  const auto shake = [this](std::size_t* moved) {
    *moved = 1;
    return SSL_do_handshake(session_);
  };
  const int done = Await(shake, deadline);
  timed_out = done == 0;
  if (timed_out) {
    const base::MutexLock lock(mutex_);
    failure_ = "it does not finish the TLS handshake";
  }
  if (done != 1) last_failure = failure();
  return done == 1;
}

ssize_t TlsChannel::TryReceive(void* buffer, std::size_t size) {
  std::size_t moved = 0;
  const Step step =
      Try([&](std::size_t* count) { return SSL_read_ex(session_, buffer, size, count); }, moved);
  if (step == Step::kDone) return static_cast<ssize_t>(moved);
  errno = step == Step::kFailed ? ECONNRESET : EAGAIN;
  return -1;
}

ssize_t TlsChannel::TrySend(const void* buffer, std::size_t size) {
  std::size_t moved = 0;
  const Step step =
      Try([&](std::size_t* count) { return SSL_write_ex(session_, buffer, size, count); }, moved);
  if (step == Step::kDone) return static_cast<ssize_t>(moved);
  errno = step == Step::kFailed ? ECONNRESET : EAGAIN;
  return -1;
}

int TlsChannel::Receive(void* buffer, std::size_t size, const omni_time_t& deadline) {
  size = std::min<std::size_t>(size, INT_MAX);
  const int moved = Await(
      [&](std::size_t* count) { return SSL_read_ex(session_, buffer, size, count); }, deadline);
  // With TLS 1.3, a server can reject the client's certificate after the client's part of the
  // handshake is complete. Then the client's first read fails.
  if (moved < 0) last_failure = failure();
  return moved;
}

int TlsChannel::Send(const void* buffer, std::size_t size, const omni_time_t& deadline) {
  size = std::min<std::size_t>(size, INT_MAX);
  return Await([&](std::size_t* count) { return SSL_write_ex(session_, buffer, size, count); },
               deadline);
}

std::string TlsChannel::failure() const {
  const base::MutexLock lock(mutex_);
  return failure_;
}

bool TlsChannel::HasBytes() {
  const base::MutexLock lock(mutex_);
  return session_ != nullptr && SSL_pending(session_) > 0;
}

void TlsChannel::Close() {
  const base::MutexLock lock(mutex_);
  if (session_ == nullptr) return;
  ERR_clear_error();
  SSL_shutdown(session_);
}

void NoteTlsFailure(std::string why) { last_failure = std::move(why); }

std::string TakeTlsFailure() { return std::exchange(last_failure, {}); }

}  // namespace gsv::orb
