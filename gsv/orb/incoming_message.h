// A message on its way from a socket to the ORB, to which it goes when it is whole.
#pragma once

#include "gsv/orb/message_assembly.h"

namespace gsv::orb {

class IncomingMessage {
 public:
  // `limit`: of a whole message, its headers included.
  explicit IncomingMessage(std::size_t limit) : assembly_(limit) {}

  MessageAssembly& assembly() { return assembly_; }
  bool whole() const { return assembly_.state() != MessageAssembly::State::kIncomplete; }
  // Copies up to `size` bytes of the message; -1 for one that is refused.
  int HandOut(void* buffer, std::size_t size);

 private:
  MessageAssembly assembly_;
  std::size_t handed_out_ = 0;
};

}  // namespace gsv::orb
