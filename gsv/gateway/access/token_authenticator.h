// Permissions by tokens.
//
// Without tokens every client on this machine may do everything. With a control token, control
// takes that one. Watching is free on this machine unless there is a watch token; from other
// machines it takes one of the two.
//
// Threads  const members may run concurrently.
// Secrets  tokens are compared in a time that does not depend on what is shown, and appear in no
//          message.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "gsv/base/error.h"
#include "gsv/gateway/access/authenticator.h"

namespace gsv::gateway::access {

struct Tokens {
  std::string control, watch;  // empty: there is none

  bool empty() const { return control.empty() && watch.empty(); }
};

// A token that nobody guesses: 16 to 256 characters that may stand in a header as they are.
// kInvalidArgument, without the token.
base::Status CheckToken(std::string_view token);

class TokenAuthenticator final : public Authenticator {
 public:
  // `is_exposed`: the server can be reached from other machines.
  TokenAuthenticator(Tokens tokens, bool is_exposed)
      : tokens_(std::move(tokens)), is_exposed_(is_exposed) {}

  // Answers before it returns. Permissions never expire.
  void Authenticate(const Credentials& credentials, Answer answer) override;
  std::string Refusal(const Principal& principal, Permission needed) const override;

  // Of a client that shows `token`; empty: it shows none.
  Permission PermissionOf(std::string_view token) const;

 private:
  const Tokens tokens_;
  const bool is_exposed_;
};

// Takes as long whatever `shown` holds.
bool EqualsSecret(std::string_view shown, std::string_view secret);

// The token of "Authorization: Bearer TOKEN"; empty: there is none.
std::string_view BearerToken(std::string_view authorization);

}  // namespace gsv::gateway::access
