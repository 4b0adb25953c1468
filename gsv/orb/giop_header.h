// The twelve bytes that each GIOP message begins with.
//
// Source  CORBA 3.1 part 2, 9.4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

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
// The header of `message` then says how long it is, and that it is whole.
void CompleteGiopHeader(std::string& message);

}  // namespace gsv::orb
