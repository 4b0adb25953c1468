// The port through which the gateway finds out who makes a request, and with what permission.
// GSV comes with one implementation, tokens (token_authenticator.h).
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "gsv/gateway/http/route.h"

namespace gsv::gateway::access {

// What of a request says who makes it.
struct Credentials {
  // Of "Authorization: Bearer TOKEN", or of a WebSocket's "?token=TOKEN"; empty: there is none.
  std::string token;
};

struct Principal {
  Permission permission = Permission::kNone;
  bool showed_credentials = false;  // right or wrong: a refusal is 403, else 401
  // When the permission ends: a WebSocket is closed then. Nothing: never.
  std::optional<std::chrono::steady_clock::time_point> expires{};
};

// Threads  Authenticate() and Refusal() are called on the server's thread, and return at once.
class Authenticator {
 public:
  using Answer = std::function<void(const Principal&)>;

  virtual ~Authenticator() = default;

  // Calls `answer` once: before it returns, or later from any thread, but in good time (the request
  // waits for it) and before the server is stopped.
  virtual void Authenticate(const Credentials& credentials, Answer answer) = 0;

  // Why a request that needs a permission is refused to this principal: a sentence without secrets.
  virtual std::string Refusal(const Principal& principal, Permission needed) const = 0;
};

}  // namespace gsv::gateway::access
