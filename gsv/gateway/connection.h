// What the server and its sessions share.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "gsv/gateway/access_rule.h"
#include "gsv/gateway/server.h"

namespace gsv::gateway {

struct ServerContext {
  ServerOptions options;
  AccessRule access;
  access::TokenRule tokens;
  Handler& handler;
  std::atomic<std::size_t> connections{0};
  std::atomic<bool> stopping{false};
};

// Who a connection belongs to.
struct Ticket {
  access::Right right = access::Right::kNone;
  std::string viewer;        // a key, or empty
  bool is_private = false;   // it acts on nothing that others see
  bool shows_token = false;  // right or wrong
};

// Counts one connection as long as it lives.
class ConnectionSlot {
 public:
  explicit ConnectionSlot(std::shared_ptr<ServerContext> context) : context_(std::move(context)) {
    ++context_->connections;
  }
  ~ConnectionSlot() { --context_->connections; }
  ConnectionSlot(const ConnectionSlot&) = delete;
  ConnectionSlot& operator=(const ConnectionSlot&) = delete;

 private:
  std::shared_ptr<ServerContext> context_;
};

// One session, as the server sees it.
class Connection {
 public:
  virtual ~Connection() = default;
  // On the server's thread: ends as soon as decency allows.
  virtual void Shutdown() = 0;
  // After the server's thread has ended: lets go of all that holds this session.
  virtual void Cut() = 0;
};

}  // namespace gsv::gateway
