// A TokenAuthenticator determines the permission of a client by its token.
//
// The control token permits control and watching, the watch token permits only watching. A server
// that has only a watch token allows no control. There are two exceptions if other machines cannot
// reach the server:
// - If the server has no tokens, every client has all permissions.
// - If the server has no watch token, a client without a token may watch.
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
