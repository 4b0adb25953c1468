// A connection of the ORB by TCP, TLS or a local socket. Either a client or this process has opened
// it.
//
// The connection joins fragments, applies the limits to messages and calls its hooks
// (connection_policy.h). The ORB gets only complete messages. A connection that this process has
// opened does these things only if it has hooks.
//
// Threads  as for omniORB's connections: one thread reads at a time, and one thread sends at a
//          time.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "gsv/base/mutex.h"
#include "gsv/orb/giop/incoming_message.h"
#include "gsv/orb/transport/channel.h"
#include "gsv/orb/transport/connection_policy.h"
#include "gsv/orb/transport/omniorb_internals.h"

namespace gsv::orb {

// The addresses as URIs, such as "giop:tcp:127.0.0.1:40123".
struct ConnectionAddresses {
  std::string own, peer;  // of this process, and of the other end
};
// Returns the addresses of a connected TCP socket. `scheme` is "giop:tcp" or "giop:ssl".
ConnectionAddresses AddressesOfTcp(int socket, const char* scheme);
// Returns the addresses of an accepted Unix domain socket. The peer of such a socket has no name.
// `server` is "giop:unix:FILE".
ConnectionAddresses AddressesOfAcceptedLocal(const std::string& server);
// Returns the addresses of a Unix domain socket that this process has connected to `server`.
ConnectionAddresses AddressesOfMadeLocal(const std::string& server);

class Connection : public omni::giopConnection,
                   public omni::SocketHolder,
                   public ConnectionControl {
 public:
  // Makes a connection that a client has opened. The connection owns the socket. `collection`
  // watches it.
  Connection(int socket, std::unique_ptr<Channel> channel, ConnectionAddresses addresses,
             omni::SocketCollection& collection, const ConnectionPolicy& policy);
  ~Connection() override;

  int Recv(void* buffer, std::size_t size, const omni_time_t& deadline) override;
  int Send(void* buffer, std::size_t size, const omni_time_t& deadline) override;
  void Shutdown() override;
  const char* myaddress() override { return addresses_.own.c_str(); }
  const char* peeraddress() override { return addresses_.peer.c_str(); }
  void setSelectable(int now, CORBA::Boolean data_in_buffer) override;
  void clearSelectable() override { SocketHolder::clearSelectable(); }
  CORBA::Boolean isSelectable() override { return pd_belong_to->isSelectable(pd_socket); }
  CORBA::Boolean Peek() override;

  bool Gather() override;
  // Called when no thread of the ORB reads, after Gather() has returned false.
  bool has_begun() const override GSV_NO_THREAD_SAFETY_ANALYSIS { return incoming_.has_begun(); }
  void Watch() override { setSelectable(1, false); }
  void End() override { Shutdown(); }

 protected:
  // Makes a connection that this process has opened.
  Connection(int socket, std::unique_ptr<Channel> channel, ConnectionAddresses addresses,
             const ConnectionPolicy& policy);

 private:
  // The common part of the two constructors above.
  Connection(int socket, std::unique_ptr<Channel> channel, ConnectionAddresses addresses,
             omni::SocketCollection& collection, const MessageLimits& limits);
  // Reads the next bytes into incoming_. Returns the same values as Recv().
  int ReadPiece(const omni_time_t& deadline) GSV_REQUIRES(mutex_);

  std::unique_ptr<Channel> channel_;
  const ConnectionAddresses addresses_;
  const std::chrono::seconds message_time_;  // MessageLimits::time
  // true if a client has opened the connection, false if this process has
  bool is_accepted_ = false;
  std::unique_ptr<ConnectionHooks> hooks_;  // null if the policy has no hooks for this connection
  std::atomic<bool> is_shut_down_ = false;  // whether Shutdown() was called
  base::Mutex mutex_;
  IncomingMessage incoming_ GSV_GUARDED_BY(mutex_);  // the message that is being received
};

// A connection that this process has opened.
class ActiveConnection final : public omni::giopActiveConnection, public Connection {
 public:
  ActiveConnection(int socket, std::unique_ptr<Channel> channel, ConnectionAddresses addresses,
                   const ConnectionPolicy& policy)
      : Connection(socket, std::move(channel), std::move(addresses), policy) {}

  // omniORB watches outgoing connections for incoming calls, which only bidirectional GIOP has. No
  // ORB here supports that.
  omni::giopActiveCollection* registerMonitor() override { return nullptr; }
  omni::giopConnection& getConnection() override { return *this; }
};

}  // namespace gsv::orb
