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
  // Calls `take` once with the next part, from any thread, now or later. nullopt ends the body. The
  // server calls Next() again when that part has been sent, so a slow client gets fewer parts.
  virtual void Next(std::function<void(std::optional<SharedBytes>)> take) = 0;
};

}  // namespace gsv::gateway
