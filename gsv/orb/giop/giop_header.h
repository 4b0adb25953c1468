// Reads the headers of GIOP messages: the twelve bytes at the start of each message, and the
// headers of requests and replies.
//
// Source  CORBA 3.1 part 2, 9.4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gsv/base/cdr_reader.h"

namespace gsv::orb {

inline constexpr std::size_t kGiopHeaderBytes = 12;  // size of a GiopHeader in a message

// The twelve bytes at the start of a message.
struct GiopHeader {
  enum Type : std::uint8_t {
    kRequest = 0,
    kReply = 1,
    kCancelRequest = 2,
    kFragment = 7,
  };
  int minor = 0;          // minor version of GIOP: 0 to 2
  std::uint8_t type = 0;  // a value of Type, or of another message type of GIOP
  bool little_endian = false;
  bool more_fragments = false;  // whether the message continues in a later fragment
  std::size_t body_bytes = 0;   // number of bytes behind this header
};

// Returns nullopt if the bytes are not the header of a message of GIOP 1.0 to 1.2. Requires at
// least 12 bytes.
std::optional<GiopHeader> ReadGiopHeader(std::string_view bytes);
// Sets the length in the header of `message`, and clears the flag "more fragments follow".
void CompleteGiopHeader(std::string& message);
// Returns a reader of `message` that starts behind its GIOP header `header`.
base::CdrReader ReaderBehind(const GiopHeader& header, std::string_view message);

// The fields of a request's header that are used.
struct RequestHeader {
  std::uint32_t id = 0;
  std::string_view operation;
};
// `in` must be at the request's header. Afterwards it is at the arguments.
RequestHeader ReadRequestHeader(base::CdrReader& in);

// The fields of a reply's header that are used.
struct ReplyHeader {
  enum Status : std::uint32_t { kNoException = 0, kUserException = 1 };
  std::uint32_t id = 0;
  std::uint32_t status = 0;  // a value of Status, or of another reply status of GIOP
};
// `in` must be at the reply's header. Afterwards it is at the results.
ReplyHeader ReadReplyHeader(base::CdrReader& in);

// Skips an object reference (IOR) at the position of `in`.
void SkipReference(base::CdrReader& in);

}  // namespace gsv::orb
