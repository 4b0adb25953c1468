// Reassembles one GIOP message at a time from the pieces in which it comes. The fragments of GIOP
// 1.2 are joined. Fragments of GIOP 1.1, compressed messages, and two messages whose fragments
// alternate are refused.
//
// Source  CORBA 3.1 part 2, 9.4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "gsv/orb/giop/giop_header.h"

namespace gsv::orb {

class MessageAssembly {
 public:
  enum class State { kIncomplete, kComplete, kRefused };

  // `limit`: bytes of a complete message, its headers included.
  explicit MessageAssembly(std::size_t limit) : limit_(limit) {}

  State state() const { return state_; }
  bool empty() const { return received_ == 0 && message_.empty(); }

  // Where and how many bytes shall come next, while it is incomplete.
  struct Room {
    char* bytes;
    std::size_t size;
  };
  Room Next();
  // `count` bytes have come there.
  void Take(std::size_t count);

  // The message, once it is complete.
  std::string& message() { return message_; }
  // Begins with the next.
  void Reset();

 private:
  void ReadHeader();
  void FinishFrame();

  std::size_t limit_;
  State state_ = State::kIncomplete;
  std::string frame_;  // a message or fragment that is coming
  std::size_t received_ = 0;
  std::size_t wanted_ = kGiopHeaderBytes;  // of the frame, as far as is known
  std::string message_;                    // joined so far
  std::uint32_t request_ = 0;              // whose fragments are joined
};

}  // namespace gsv::orb
