// Receives a message from a socket, and passes it to the ORB when it is complete.
#pragma once

#include "gsv/orb/giop/message_assembly.h"

namespace gsv::orb {

class IncomingMessage {
 public:
  // `limit` is the maximum size of a message with its headers, in bytes.
  explicit IncomingMessage(std::size_t limit) : assembly_(limit) {}

  // The buffer into which the caller writes received bytes.
  MessageAssembly& assembly() { return assembly_; }
  // Returns whether the caller should call HandOut(): a message is complete, or it was refused, so
  // that HandOut() returns -1. Drops CancelRequest messages, because no servant supports them.
  bool IsReady();
  // Whether the whole message has arrived and no part of it has been passed to the ORB.
  bool is_new() const {
    return assembly_.state() == MessageAssembly::State::kComplete && handed_out_ == 0;
  }
  // Returns whether a message has been received in part.
  bool has_begun() const {
    return assembly_.state() == MessageAssembly::State::kIncomplete && !assembly_.empty();
  }
  // Copies up to `size` bytes of the message to `buffer`. Returns their number, or -1 if the
  // message is refused.
  int HandOut(void* buffer, std::size_t size);

 private:
  MessageAssembly assembly_;
  std::size_t handed_out_ = 0;  // number of bytes of the message that HandOut() has copied
};

}  // namespace gsv::orb
