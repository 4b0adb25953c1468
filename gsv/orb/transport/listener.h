// Accepts connections for an endpoint, and watches them for the ORB.
//
// With TLS, the accepting thread also does the handshakes. It does a step of a handshake whenever
// bytes have arrived, without waiting. So a peer that stalls does not delay other peers. The ORB
// sees a peer only after the peer has shown its certificate.
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

// Alarm wakes the accepting thread at regular intervals, so that slow handshakes end.
// PendingHandshake is a client whose TLS handshake is not complete.
class Alarm;
class PendingHandshake;

class Listener {
 public:
  // `collection`, which must outlive the listener, watches the endpoint and its connections. If
  // there is no context, TLS is not used.
  Listener(omni::SocketCollection& collection, std::shared_ptr<const TlsContext> context);
  ~Listener();

  bool speaks_tls() const { return context_ != nullptr; }
  // Like AcceptAndMonitor() of omniORB's endpoints: waits for the next connection. During the wait,
  // it calls `readable` for each connection from which the ORB must read. Returns null after
  // Poke().
  omni::giopConnection* Await(omni::giopConnection::notifyReadable_t readable, void* cookie);
  // Ends Await().
  void Poke() { poked_ = true; }

  // Accepts a client. The listener becomes the owner of the socket.
  void Accept(int socket, ConnectionAddresses addresses);
  // Called when bytes have arrived on a socket that the collection watches, except the endpoint.
  void Notify(omni::SocketHolder* holder);

 private:
  // Makes a connection whose handshake, if any, is complete. Await() returns it.
  void AddConnection(int socket, std::unique_ptr<Channel> channel, ConnectionAddresses addresses);
  // Continues a handshake, and makes a connection of the socket when the handshake is complete.
  void Proceed(PendingHandshake* pending);
  // Destroys handshakes that have ended or take too long. If there are too many handshakes, also
  // destroys the oldest ones.
  void Dismiss();

  omni::SocketCollection& collection_;
  const std::shared_ptr<const ConnectionPolicy> policy_ = CurrentConnectionPolicy();
  const std::shared_ptr<const TlsContext> context_;
  std::deque<Connection*> accepted_;  // accepted connections that the ORB does not know yet
  // ordered from the oldest to the newest
  std::vector<std::unique_ptr<PendingHandshake>> pending_handshakes_;
  std::unique_ptr<Alarm> alarm_;  // null without TLS; rings while there are pending handshakes
  // The arguments of the current Await().
  omni::giopConnection::notifyReadable_t readable_ = nullptr;
  void* cookie_ = nullptr;
  std::atomic<bool> poked_ = false;  // whether Poke() was called
};

}  // namespace gsv::orb
