// Reads CDR, the encoding of CORBA's messages and references and of ROS 2's messages, without an
// ORB. The bytes are untrusted input: the reader fails at the first value that exceeds the
// remaining bytes, and from then on reads only zeros.
//
// Source  CORBA 3.1 part 2, 7.3; OMG DDS-XTypes 1.3, 7.4.3 (XCDR version 1, the same encoding).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace gsv::base {

class CdrReader {
 public:
  // `bytes` must outlive the reader; alignment counts from the first byte. `minor` is the minor
  // version of GIOP: 1.1 and 1.2 encode wide characters differently.
  CdrReader(std::string_view bytes, bool little_endian, int minor = 2, std::size_t position = 0)
      : bytes_(bytes), position_(position), minor_(minor), little_endian_(little_endian) {
    if (position > bytes.size()) Fail();
  }

  bool ok() const { return ok_; }
  // Makes ok() false. All later values are read as zero.
  void Fail() {
    ok_ = false;
    position_ = bytes_.size();
  }
  int minor() const { return minor_; }
  std::size_t position() const { return position_; }
  std::size_t remaining() const { return bytes_.size() - position_; }
  // The address of the next byte.
  const char* here() const { return bytes_.data() + position_; }

  // Skips bytes up to a multiple of `alignment`, a power of two.
  void Align(std::size_t alignment) { Skip((0 - position_) & (alignment - 1)); }
  // Skips `count` bytes. Fails if fewer remain.
  void Skip(std::size_t count) {
    if (count > remaining()) return Fail();
    position_ += count;
  }
  // Skips `count` values of `size` bytes each, aligned to `alignment`.
  void SkipValues(std::size_t count, std::size_t size, std::size_t alignment) {
    if (count == 0) return;
    Align(alignment);
    if (count > remaining() / size) return Fail();
    Skip(count * size);
  }

  // These functions read a number of this IDL type.
  std::uint8_t Octet() { return Number<std::uint8_t>(); }
  std::uint16_t UShort() { return Number<std::uint16_t>(); }
  std::uint32_t ULong() { return Number<std::uint32_t>(); }
  std::uint64_t ULongLong() { return Number<std::uint64_t>(); }
  // Reads a number that is aligned to its size.
  template <typename T>
  requires std::is_arithmetic_v<T> T Number() {
    Align(sizeof(T));
    if (sizeof(T) > remaining()) Fail();
    if (!ok_) return 0;
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), here(), sizeof(T));
    position_ += sizeof(T);
    if (little_endian_ != (std::endian::native == std::endian::little)) {
      std::reverse(bytes.begin(), bytes.end());
    }
    return std::bit_cast<T>(bytes);
  }

  // Reads a sequence of octets: its length, and that many bytes.
  std::string_view Octets() {
    const std::uint32_t length = ULong();
    if (length > remaining()) Fail();
    if (!ok_) return {};
    const std::string_view octets(here(), length);
    position_ += length;
    return octets;
  }
  // Reads a string without its terminating zero. Fails if the zero is missing, or if the string
  // contains another zero: a CORBA string contains no zero (CORBA 3.1 part 2, 9.3.2.7), and omniORB
  // would cut the string there.
  std::string_view String() {
    std::string_view text = Octets();
    if (text.empty() || text.find('\0') != text.size() - 1) {
      Fail();
      return {};
    }
    text.remove_suffix(1);
    return text;
  }
  // Reads the number of elements of a sequence. Fails if the count exceeds the number of remaining
  // bytes.
  std::uint32_t Count() {
    const std::uint32_t count = ULong();
    if (count > remaining()) Fail();
    return ok_ ? count : 0;
  }
  // Reads an encapsulation: a sequence of octets with its own byte order and alignment.
  CdrReader Encapsulation() {
    CdrReader inner = OfEncapsulation(Octets(), minor_);
    if (!ok_) inner.Fail();
    return inner;
  }
  // Returns a reader of the content of the encapsulation `octets`.
  static CdrReader OfEncapsulation(std::string_view octets, int minor = 2) {
    CdrReader inner(octets, !octets.empty() && octets.front() == 1, minor, 1);
    if (!octets.empty() && static_cast<unsigned char>(octets.front()) > 1) inner.Fail();
    return inner;
  }

 private:
  std::string_view bytes_;
  std::size_t position_;  // index of the next byte in bytes_
  int minor_;
  bool little_endian_;
  bool ok_ = true;
};

}  // namespace gsv::base
