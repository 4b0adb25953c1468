// Data that the server shares with the sessions of its connections.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include <boost/asio/ssl/context.hpp>

#include "gsv/gateway/access/access_rule.h"
#include "gsv/gateway/server/server.h"

namespace gsv::gateway {

// The objects that all connections of a server use.
struct ServerContext {
  ServerOptions options;  // as passed to Server::Start()
  AccessRule access;      // checks the Host and Origin headers
  const std::shared_ptr<access::Authenticator> authenticator;
  Handler& handler;
  const std::shared_ptr<metrics::Traffic> traffic;
  const std::shared_ptr<boost::asio::ssl::context> tls;  // null for plain HTTP
  std::atomic<std::size_t> uploads{0};                   // current number of uploads
  std::atomic<bool> stopping{false};                     // whether the server is being stopped
};

// The owner of a WebSocket.
struct SocketOwner {
  access::Principal principal;  // the sender of the request that opened it
  std::string viewer;           // key of the viewer, or empty
  bool is_private = false;      // whether the client's commands affect only its own replay
};

// Counts one connection during its lifetime.
class ConnectionSlot {
 public:
  explicit ConnectionSlot(std::shared_ptr<ServerContext> context) : context_(std::move(context)) {
    ++context_->traffic->connections;
  }
  ~ConnectionSlot() { --context_->traffic->connections; }
  ConnectionSlot(const ConnectionSlot&) = delete;
  ConnectionSlot& operator=(const ConnectionSlot&) = delete;

 private:
  std::shared_ptr<ServerContext> context_;
};

// Counts one upload during its lifetime. The number of uploads is limited because they are held in
// memory.
class UploadSlot {
 public:
  // Returns null if no slot is free.
  static std::unique_ptr<UploadSlot> Take(std::shared_ptr<ServerContext> context) {
    const std::size_t limit = context->options.limits.uploads_at_once;
    auto slot = std::unique_ptr<UploadSlot>(new UploadSlot(std::move(context)));
    return slot->number_ <= limit ? std::move(slot) : nullptr;
  }
  ~UploadSlot() { --context_->uploads; }
  UploadSlot(const UploadSlot&) = delete;
  UploadSlot& operator=(const UploadSlot&) = delete;

 private:
  explicit UploadSlot(std::shared_ptr<ServerContext> context)
      : context_(std::move(context)), number_(++context_->uploads) {}

  const std::shared_ptr<ServerContext> context_;
  const std::size_t number_;  // number of uploads, including this one, when it began
};

// The interface with which the server ends a session (HttpSession or WebSocketSession).
class Connection {
 public:
  virtual ~Connection() = default;
  // Ends the session soon, with the closing handshake. Called on the server's thread.
  virtual void Shutdown() = 0;
  // Releases all references to this session. Called after the server's thread has ended.
  virtual void Cut() = 0;
};

}  // namespace gsv::gateway
