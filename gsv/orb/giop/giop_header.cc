#include "gsv/orb/giop/giop_header.h"

namespace gsv::orb {
namespace {

using base::CdrReader;

// Skips a list of service contexts, or of a reference's profiles. Each entry of such a list is a
// number and a sequence of octets.
void SkipTaggedOctets(CdrReader& in) {
  for (std::uint32_t left = in.Count(); left > 0 && in.ok(); --left) {
    in.ULong();
    in.Octets();
  }
}

void SkipTarget(CdrReader& in) {
  switch (in.UShort()) {
    case 0:  // an object key
      in.Octets();
      return;
    case 1:  // a profile
      in.ULong();
      in.Octets();
      return;
    default:
      in.ULong();
      SkipReference(in);
  }
}

}  // namespace

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

CdrReader ReaderBehind(const GiopHeader& header, std::string_view message) {
  return CdrReader(message, header.little_endian, header.minor, kGiopHeaderBytes);
}

RequestHeader ReadRequestHeader(CdrReader& in) {
  RequestHeader header;
  if (in.minor() < 2) SkipTaggedOctets(in);
  header.id = in.ULong();
  in.Skip(1);
  if (in.minor() >= 1) in.Skip(3);
  if (in.minor() == 2) {
    SkipTarget(in);
    header.operation = in.String();
    SkipTaggedOctets(in);
    if (in.remaining() > 0) in.Align(8);
  } else {
    in.Octets();
    header.operation = in.String();
    in.Octets();  // the principal
  }
  return header;
}

ReplyHeader ReadReplyHeader(CdrReader& in) {
  if (in.minor() < 2) SkipTaggedOctets(in);
  ReplyHeader header;
  header.id = in.ULong();
  header.status = in.ULong();
  if (in.minor() == 2) {
    SkipTaggedOctets(in);
    if (in.remaining() > 0) in.Align(8);
  }
  return header;
}

void SkipReference(CdrReader& in) {
  in.String();
  SkipTaggedOctets(in);
}

}  // namespace gsv::orb
