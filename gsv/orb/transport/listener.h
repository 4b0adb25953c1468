// Accepts connections for an endpoint, and watches them for the ORB.
//
// With TLS, the thread that accepts also does the handshakes: a step whenever bytes have come,
// without waiting. A peer that stalls delays nobody, and the ORB sees no peer before it has shown
// its certificate.
//
// Threads  Await() and Notify(): the thread that accepts. Poke(): any.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <vector>

#include "gsv/orb/transport/connection.h"
#include "gsv/orb/transport/tls_context.h"

namespace gsv::orb {

class Alarm;
class PendingHandshake;

class Listener {
 public:
  // `collection`, which must outlive it, watches the endpoint and its connections. Without a
  // context there is no TLS.
  Listener(omni::SocketCollection& collection, std::shared_ptr<const TlsContext> context);
  ~Listener();

  bool speaks_tls() const { return context_ != nullptr; }
  // As AcceptAndMonitor() of omniORB's endpoints: waits for the next connection, and calls
  // `readable` for each that the ORB shall read meanwhile. Null after Poke().
  omni::giopConnection* Await(omni::giopConnection::notifyReadable_t readable, void* cookie);
  void Poke() { poked_ = true; }

  // Takes over the socket of a client.
  void Accept(int socket, ConnectionAddresses addresses);
  // Bytes have come for one of those that the collection watches, except the endpoint.
  void Notify(omni::SocketHolder* holder);

 private:
  void AddConnection(int socket, std::unique_ptr<Channel> channel, ConnectionAddresses addresses);
  void Proceed(PendingHandshake* pending);
  void Dismiss();

  omni::SocketCollection& collection_;
  const std::shared_ptr<const ConnectionPolicy> policy_ = CurrentConnectionPolicy();
  const std::shared_ptr<const TlsContext> context_;
  std::deque<Connection*> accepted_;  // those that the ORB does not know yet
  std::vector<std::unique_ptr<PendingHandshake>> pending_handshakes_;  // the oldest first
  std::unique_ptr<Alarm> alarm_;                                       // rings while there are any
  omni::giopConnection::notifyReadable_t readable_ = nullptr;
  void* cookie_ = nullptr;
  std::atomic<bool> poked_ = false;
};

}  // namespace gsv::orb
