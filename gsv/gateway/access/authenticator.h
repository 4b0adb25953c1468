// An Authenticator determines who sends a request (the principal) and which permission the sender
// has. GSV has one implementation, which checks tokens (token_authenticator.h).
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "gsv/gateway/http/route.h"

namespace gsv::gateway::access {

// The credentials of a request.
struct Credentials {
  // the token of "Authorization: Bearer TOKEN", or of "?token=TOKEN" in the address of a WebSocket
  // or an image; empty if there is none
  std::string token;
};

// The sender of a request: the permission, and how long it lasts.
struct Principal {
  Permission permission = Permission::kNone;
  // Whether the request had credentials. If so, a refusal has status 403, otherwise 401.
  bool showed_credentials = false;
  // The time at which the permission ends and a WebSocket is closed. nullopt: never.
  std::optional<std::chrono::steady_clock::time_point> expires{};
};

// Threads  the server's thread calls Authenticate() and Refusal(), which must return at once.
class Authenticator {
 public:
  using Answer = std::function<void(const Principal&)>;

  virtual ~Authenticator() = default;

  // Calls `answer` exactly once, before it returns or later from any thread. The request waits for
  // the answer. `answer` must be called before the server stops.
  virtual void Authenticate(const Credentials& credentials, Answer answer) = 0;

  // Returns the reason for refusing a request of this principal: a sentence without secrets.
  virtual std::string Refusal(const Principal& principal, Permission needed) const = 0;
};

}  // namespace gsv::gateway::access
