// What a request takes: nothing, the right to watch, the right to control.
#pragma once

#include <string_view>

#include "gsv/gateway/access/token_rule.h"
#include "gsv/gateway/target.h"

namespace gsv::gateway::access {

struct Need {
  Right right = Right::kNone;
  // It changes what others see, so that it is refused while somebody else holds control.
  bool acts = false;
};

// The viewer's own files take nothing: they hold no secret, and ask for the token. A replay of
// one's own is watching, whatever is done with it.
Need NeedOf(std::string_view method, const Target& target);

}  // namespace gsv::gateway::access
