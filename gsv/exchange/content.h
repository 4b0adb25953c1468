// Writes and reads the part of a control cycle whose size varies (CycleSlot::content): names of
// sensors, and their readings. Numbers have the byte order of the host, because both processes are
// on one host. Each item starts at a multiple of 8 bytes.
//
// Threads  any.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace gsv::exchange {

// Writes into a buffer of fixed size. After the first write that does not fit, ok() is false and
// nothing more is written.
class ContentWriter {
 public:
  explicit ContentWriter(std::span<std::byte> buffer) : buffer_(buffer) {}

  // Adds a number of eight bytes.
  template <typename Number>
  void Add(Number number) {
    static_assert(sizeof(Number) == 8);
    AddBytes(&number, 1, sizeof number);
  }
  // Adds the length and the bytes of the text.
  void Add(std::string_view text) {
    Add(std::uint64_t{text.size()});
    AddBytes(text.data(), text.size(), 1);
  }
  // Adds the count and the values.
  void Add(std::span<const double> values) {
    Add(std::uint64_t{values.size()});
    AddBytes(values.data(), values.size(), sizeof(double));
  }

  bool ok() const { return is_ok_; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(used_); }

 private:
  // Adds `count` elements of `each` bytes, padded with zeros to a multiple of eight bytes.
  void AddBytes(const void* from, std::size_t count, std::size_t each) {
    const std::size_t size = (count * each + 7) / 8 * 8;
    if (size > buffer_.size() - used_) is_ok_ = false;
    if (!is_ok_ || size == 0) return;
    std::memset(buffer_.data() + used_ + size - 8, 0, 8);
    std::memcpy(buffer_.data() + used_, from, count * each);
    used_ += size;
  }

  std::span<std::byte> buffer_;
  std::size_t used_ = 0;  // number of bytes that were written
  bool is_ok_ = true;
};

// Reads what ContentWriter has written. The other process may change the bytes during the read.
// Then a value may be wrong, but the reader stays inside the buffer. After the first item that does
// not fit, ok() is false, numbers are 0, and lists are empty.
class ContentReader {
 public:
  explicit ContentReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  // Reads a number of eight bytes.
  template <typename Number>
  Number Take() {
    static_assert(sizeof(Number) == 8);
    Number number{};
    if (const std::byte* const from = Skip(1, sizeof number)) {
      std::memcpy(&number, from, sizeof number);
    }
    return number;
  }
  // The text and the values are valid as long as the buffer.
  std::string_view TakeText() {
    const auto size = Take<std::uint64_t>();
    const std::byte* const from = Skip(size, 1);
    if (from == nullptr) return {};
    return {reinterpret_cast<const char*>(from), static_cast<std::size_t>(size)};
  }
  std::span<const double> TakeValues() {
    const auto count = Take<std::uint64_t>();
    const std::byte* const from = Skip(count, sizeof(double));
    if (from == nullptr) return {};
    return {reinterpret_cast<const double*>(from), static_cast<std::size_t>(count)};
  }

  bool ok() const { return is_ok_; }

 private:
  // Returns the start of the next `count` elements of `each` bytes, or null if the buffer has fewer
  // elements.
  const std::byte* Skip(std::uint64_t count, std::size_t each) {
    if (count > (bytes_.size() - used_) / each) is_ok_ = false;
    if (!is_ok_) return nullptr;
    const std::byte* const from = bytes_.data() + used_;
    used_ += (static_cast<std::size_t>(count) * each + 7) / 8 * 8;
    if (used_ > bytes_.size()) used_ = bytes_.size();
    return from;
  }

  std::span<const std::byte> bytes_;
  std::size_t used_ = 0;  // number of bytes that were read
  bool is_ok_ = true;
};

}  // namespace gsv::exchange
