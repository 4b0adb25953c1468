// Reads and writes the basic types of MCAP files: numbers (little endian, unaligned), and strings
// and maps with 32-bit lengths.
#pragma once

#include <bit>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/check.h"

namespace gsv::recording {

static_assert(std::endian::native == std::endian::little,
              "little-endian numbers are copied from memory without conversion");

using Bytes = std::vector<std::byte>;
using StringMap = std::map<std::string, std::string>;

inline void PutBytes(Bytes& out, std::span<const std::byte> bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

template <std::unsigned_integral Number>
void Put(Bytes& out, Number value) {
  PutBytes(out, std::as_bytes(std::span(&value, 1)));
}

// `time` must not be negative.
inline void PutTime(Bytes& out, std::chrono::nanoseconds time) {
  GSV_CHECK(time.count() >= 0);
  Put(out, static_cast<std::uint64_t>(time.count()));
}

inline void PutString(Bytes& out, std::string_view text) {
  Put(out, static_cast<std::uint32_t>(text.size()));
  PutBytes(out, std::as_bytes(std::span(text)));
}

// Reads values from bytes. After a value that exceeds the remaining bytes, ok() is false and every
// read returns zero or an empty value.
class ByteReader {
 public:
  // `bytes` must outlive the reader and the values that it returns.
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }
  std::size_t remaining() const { return bytes_.size(); }

  // Reads the next `size` bytes.
  std::span<const std::byte> Take(std::uint64_t size) {
    if (size > bytes_.size()) {
      ok_ = false;
      bytes_ = {};
      return {};
    }
    const std::span<const std::byte> taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }

  // Reads a number.
  template <std::unsigned_integral Number>
  Number Get() {
    Number value = 0;
    const std::span<const std::byte> bytes = Take(sizeof value);
    if (!bytes.empty()) std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }

  // Reads a time. The reader fails for times after the year 2262.
  std::chrono::nanoseconds GetTime() {
    const auto value = Get<std::uint64_t>();
    if (value > INT64_MAX) ok_ = false;
    return std::chrono::nanoseconds(ok_ ? static_cast<std::int64_t>(value) : 0);
  }

  // Reads the length of a text, and the text.
  std::string GetString() {
    const std::span<const std::byte> bytes = Take(Get<std::uint32_t>());
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }

 private:
  std::span<const std::byte> bytes_;
  bool ok_ = true;
};

}  // namespace gsv::recording
