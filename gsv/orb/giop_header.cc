#include "gsv/orb/giop_header.h"

#include "gsv/orb/cdr_reader.h"

namespace gsv::orb {

std::optional<GiopHeader> ReadGiopHeader(std::string_view bytes) {
  if (bytes.substr(0, 5) != std::string_view("GIOP\x01", 5)) return std::nullopt;
  const auto flags = static_cast<std::uint8_t>(bytes[6]);
  GiopHeader header{.minor = static_cast<std::uint8_t>(bytes[5]),
                    .type = static_cast<std::uint8_t>(bytes[7]),
                    .little_endian = (flags & 1) != 0};
  if (header.minor > 2) return std::nullopt;
  header.more_fragments = header.minor > 0 && (flags & 2) != 0;
  header.body_bytes = CdrReader(bytes, header.little_endian, header.minor, 8).ULong();
  return header;
}

void CompleteGiopHeader(std::string& message) {
  const bool little_endian = (message[6] & 1) != 0;
  message[6] = little_endian ? '\x01' : '\x00';
  const std::size_t body = message.size() - kGiopHeaderBytes;
  for (int i = 0; i < 4; ++i) {
    const int shift = 8 * (little_endian ? i : 3 - i);
    message[8 + static_cast<std::size_t>(i)] = static_cast<char>(body >> shift);
  }
}

}  // namespace gsv::orb
