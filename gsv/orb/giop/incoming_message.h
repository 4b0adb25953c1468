// A message on its way from a socket to the ORB. The ORB receives it when it is complete.
#pragma once

#include "gsv/orb/giop/message_assembly.h"

namespace gsv::orb {

class IncomingMessage {
 public:
  // `limit`: of a whole message, its headers included.
  explicit IncomingMessage(std::size_t limit) : assembly_(limit) {}

  MessageAssembly& assembly() { return assembly_; }
  // Whether there is a message for the ORB, be it one that is refused. Requests to cancel are
  // dropped, as no servant here can act on them.
  bool IsThere();
  // Whether the message is complete and the ORB has received none of it.
  bool is_new() const {
    return assembly_.state() == MessageAssembly::State::kComplete && handed_out_ == 0;
  }
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
