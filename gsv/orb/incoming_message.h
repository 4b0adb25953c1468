// A message on its way from a socket to the ORB, to which it goes when it is whole.
#pragma once

#include "gsv/orb/message_assembly.h"

namespace gsv::orb {

class IncomingMessage {
 public:
  // `limit`: of a whole message, its headers included.
  explicit IncomingMessage(std::size_t limit) : assembly_(limit) {}

  MessageAssembly& assembly() { return assembly_; }
  // Whether there is a message for the ORB, be it one that is refused. Requests to cancel, which
  // nobody heeds, are let go.
  bool IsThere();
  // Bytes of a message have come, and more are needed.
  bool has_begun() const {
    return assembly_.state() == MessageAssembly::State::kIncomplete && !assembly_.empty();
  }
  // Copies up to `size` bytes of the message; -1 for one that is refused.
  int HandOut(void* buffer, std::size_t size);

 private:
  MessageAssembly assembly_;
  std::size_t handed_out_ = 0;
};

}  // namespace gsv::orb
