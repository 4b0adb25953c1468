// A BodyStream is the body of a response that is sent part by part, until the client or the server
// ends it.
#pragma once

#include <functional>
#include <optional>

#include "gsv/gateway/foxglove/shared_bytes.h"

namespace gsv::gateway {

// The body of a response that is sent part by part.
class BodyStream {
 public:
  virtual ~BodyStream() = default;
  // Calls `take` exactly once, now or later, from any thread: with the next part, or with nullopt
  // to end the body. The server calls Next() again when it has sent the part, so a slow client gets
  // fewer parts.
  virtual void Next(std::function<void(std::optional<SharedBytes>)> take) = 0;
};

}  // namespace gsv::gateway
