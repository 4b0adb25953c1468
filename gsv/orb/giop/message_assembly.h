// Reassembles one GIOP message at a time from the received bytes. Fragments of GIOP 1.2 are
// joined. Fragments of GIOP 1.1, compressed messages, and interleaved fragments of several messages
// are refused.
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
  // kRefused: the bytes are no valid message or exceed the limit. The connection must end.
  enum class State { kIncomplete, kComplete, kRefused };

  // `limit` is the maximum size of a complete message with its headers, in bytes.
  explicit MessageAssembly(std::size_t limit) : limit_(limit) {}

  State state() const { return state_; }
  bool empty() const { return received_ == 0 && message_.empty(); }

  // The free part of the buffer, for the next bytes of an incomplete message.
  struct Room {
    char* bytes;
    std::size_t size;
  };
  // Returns the free part of the buffer.
  Room Next();
  // Call this when `count` bytes were written to the buffer.
  void Take(std::size_t count);

  // The complete message.
  std::string& message() { return message_; }
  // Removes the message from the buffer, so that the next message can be received.
  void Reset();

 private:
  // Reads the GIOP header at the start of frame_, and sets wanted_ to the size of the frame.
  void ReadHeader();
  // Appends the complete frame_ to message_.
  void FinishFrame();

  std::size_t limit_;  // maximum size of a message with its headers, in bytes
  State state_ = State::kIncomplete;
  std::string frame_;         // the message or fragment that is being received
  std::size_t received_ = 0;  // number of bytes in frame_ so far
  std::size_t wanted_ =
      kGiopHeaderBytes;  // size of the frame; until its header has arrived, size of the header
  std::string message_;  // the fragments that were joined so far
  std::uint32_t request_ = 0;  // id of the request whose fragments are joined
};

}  // namespace gsv::orb
