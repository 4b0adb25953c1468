// A TokenAuthenticator determines the permission of a client by its token.
//
// Without tokens, every client on this machine has all permissions. A control token is required for
// control. Watching needs no token on this machine, unless there is a watch token. Clients on other
// machines always need a control token or a watch token.
//
// Threads  const members may run concurrently.
// Secrets  tokens are compared in constant time, and appear in no message.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "gsv/base/error.h"
#include "gsv/gateway/access/authenticator.h"

namespace gsv::gateway::access {

// The tokens that clients of a server can use: one for control, one for watching.
struct Tokens {
  std::string control, watch;  // empty: there is no such token

  bool empty() const { return control.empty() && watch.empty(); }
};

// Checks that a token has 16 to 256 characters that are valid in a header. The error
// kInvalidArgument does not contain the token.
base::Status CheckToken(std::string_view token);

// Determines the permission of a client by its token.
class TokenAuthenticator final : public Authenticator {
 public:
  // `is_exposed` means that other machines can reach the server.
  TokenAuthenticator(Tokens tokens, bool is_exposed)
      : tokens_(std::move(tokens)), is_exposed_(is_exposed) {}

  // Answers before it returns. Permissions never expire.
  void Authenticate(const Credentials& credentials, Answer answer) override;
  std::string Refusal(const Principal& principal, Permission needed) const override;

  // Returns the permission of a client with `token`, which is empty if the client has no token.
  Permission PermissionOf(std::string_view token) const;

 private:
  const Tokens tokens_;
  const bool is_exposed_;
};

// Compares two secrets in constant time.
bool EqualsSecret(std::string_view shown, std::string_view secret);

// Returns the token of "Authorization: Bearer TOKEN"; empty if there is none.
std::string_view BearerToken(std::string_view authorization);

}  // namespace gsv::gateway::access
