// The headers of GIOP messages: the twelve bytes that each begins with, and those of requests and
// replies.
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

inline constexpr std::size_t kGiopHeaderBytes = 12;

struct GiopHeader {
  enum Type : std::uint8_t {
    kRequest = 0,
    kReply = 1,
    kCancelRequest = 2,
    kFragment = 7,
  };
  int minor = 0;
  std::uint8_t type = 0;
  bool little_endian = false;
  bool more_fragments = false;
  std::size_t body_bytes = 0;
};

// Nothing for bytes that begin no message of GIOP 1.0 to 1.2. `bytes` are at least 12.
std::optional<GiopHeader> ReadGiopHeader(std::string_view bytes);
// Sets the length in the header of `message`, and that no fragments follow.
void CompleteGiopHeader(std::string& message);
// Reads `message` from behind its GIOP header, which is `header`.
base::CdrReader ReaderBehind(const GiopHeader& header, std::string_view message);

struct RequestHeader {
  std::uint32_t id = 0;
  std::string_view operation;
};
// `in` is at the request's header, and then at the arguments.
RequestHeader ReadRequestHeader(base::CdrReader& in);

struct ReplyHeader {
  enum Status : std::uint32_t { kNoException = 0, kUserException = 1 };
  std::uint32_t id = 0;
  std::uint32_t status = 0;
};
// `in` is at the reply's header, and then at the results.
ReplyHeader ReadReplyHeader(base::CdrReader& in);

// `in` is at an object reference (IOR), and then behind it.
void SkipReference(base::CdrReader& in);

}  // namespace gsv::orb
