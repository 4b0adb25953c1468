// For tests: writes GIOP 1.2 messages, valid or invalid, byte by byte in little-endian CDR.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gsv::orb {

// Bytes in CDR. Each function appends one value, with its padding, and returns this object.
class RawCdr {
 public:
  // Appends zeros up to a multiple of `alignment` bytes.
  RawCdr& Align(std::size_t alignment) {
    while (bytes_.size() % alignment != 0) bytes_.push_back('\0');
    return *this;
  }
  RawCdr& Octet(std::uint8_t value) {
    bytes_.push_back(static_cast<char>(value));
    return *this;
  }
  RawCdr& UShort(std::uint16_t value) { return Align(2).Number(value, 2); }
  RawCdr& ULong(std::uint32_t value) { return Align(4).Number(value, 4); }
  // Appends a sequence: the number of octets, then the octets.
  RawCdr& Octets(std::string_view octets) {
    ULong(static_cast<std::uint32_t>(octets.size()));
    bytes_ += octets;
    return *this;
  }
  RawCdr& String(std::string_view text) { return Octets(std::string(text) + '\0'); }
  // Appends the bytes alone, without a length and without padding.
  RawCdr& Raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  RawCdr& Number(std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes_.push_back(static_cast<char>(value >> (8 * i)));
    return *this;
  }

  std::string bytes_;
};

enum class MessageType : std::uint8_t {
  kRequest = 0,
  kReply = 1,
  kCancelRequest = 2,
  kFragment = 7
};

inline std::string RawMessage(MessageType type, const std::string& after_the_header,
                              bool more_fragments = false) {
  const std::uint8_t flags = more_fragments ? 3 : 1;
  return RawCdr()
      .Raw(std::string_view("GIOP\x01\x02", 6))
      .Octet(flags)
      .Octet(static_cast<std::uint8_t>(type))
      .Octets(after_the_header)
      .bytes();
}

// Returns a request. `body` begins at a multiple of eight bytes.
inline std::string RawRequest(std::string_view key, std::string_view operation,
                              std::string_view body, std::uint32_t id = 1) {
  RawCdr request;
  // The ULong(0) stands for the last bytes of the GIOP header, so that the alignment is right.
  request.ULong(0).ULong(id).Octet(3).Octet(0).Octet(0).Octet(0).UShort(0);
  request.Octets(key).String(operation).ULong(0);
  request.Align(8).Raw(body);
  return RawMessage(MessageType::kRequest, request.bytes().substr(4));
}

inline std::string RawReply(std::uint32_t id, std::string_view body) {
  RawCdr reply;
  reply.ULong(0).ULong(id).ULong(0).ULong(0);
  reply.Align(8).Raw(body);
  return RawMessage(MessageType::kReply, reply.bytes().substr(4));
}

}  // namespace gsv::orb
