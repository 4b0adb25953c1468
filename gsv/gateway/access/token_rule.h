// What people may do who reach the server: those who show a token, and those who show none.
//
// Without tokens everybody on this machine may do everything. With a control token, acting needs
// it. Watching is free on this machine unless there is a watch token; from elsewhere it takes one
// of the two.
//
// Threads  const members may run concurrently.
// Secrets  tokens are compared in a time that does not depend on what is shown, and appear in no
//          message.
#pragma once

#include <string>
#include <string_view>

#include "gsv/base/error.h"

namespace gsv::gateway::access {

enum class Right { kNone, kWatch, kControl };

struct Tokens {
  std::string control, watch;  // empty: there is none

  bool empty() const { return control.empty() && watch.empty(); }
};

// A token that nobody guesses: 16 to 256 characters that may stand in a header as they are.
// kInvalidArgument, without the token.
base::Status CheckToken(std::string_view token);

class TokenRule {
 public:
  // `is_exposed`: the server can be reached from other machines.
  TokenRule(Tokens tokens, bool is_exposed) : tokens_(std::move(tokens)), is_exposed_(is_exposed) {}

  // Of who shows `token`; empty: shows none.
  Right RightOf(std::string_view token) const;
  // Why who has a right may not do what takes `needed`, a sentence; `shows_token`: right or wrong.
  std::string Refusal(bool shows_token, Right has, Right needed) const;

 private:
  const Tokens tokens_;
  const bool is_exposed_;
};

// Takes as long whatever `shown` holds.
bool EqualsSecret(std::string_view shown, std::string_view secret);

// The token of "Authorization: Bearer TOKEN"; empty: there is none.
std::string_view BearerToken(std::string_view authorization);

}  // namespace gsv::gateway::access
