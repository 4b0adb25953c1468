// What a request takes: nothing, the right to watch, the right to control.
#pragma once

#include <string>
#include <string_view>

#include "gsv/gateway/access/token_rule.h"
#include "gsv/gateway/http/target.h"

namespace gsv::gateway::access {

struct Need {
  Right right = Right::kNone;
  // The simulation that it changes for all who see it, so that it is refused while somebody else
  // holds control of that one; empty: none.
  std::string acts_on{};
};

// The viewer's own files take nothing: they hold no secret, and ask for the token. A replay of
// one's own is watching, whatever is done with it. What concerns no simulation that is there (a new
// one, uploads, the broker) takes no control of any.
Need NeedOf(std::string_view method, const Target& target);

}  // namespace gsv::gateway::access
