// Converts messages to bytes and back, in ROS 2's serialisation.
//
// Format   XCDR version 1, little endian (OMG DDS-XTypes 1.3, section 7.4.3): a four-byte
//          encapsulation header 00 01 00 00, then the fields; each primitive is aligned to its
//          size, counted from the end of that header. A string is its length with the final NUL
//          (uint32), its bytes and the NUL; a sequence is its count (uint32) and its elements.
// Errors   writing cannot fail. Reading accepts any bytes. The memory that reading allocates is at
//          most a small multiple of the size of these bytes, whatever lengths they declare.
//
// The generated functions (gsv/messages/sensor_msgs.h and so on) are used as
//   Encode(range, bytes);                                   // appends a whole message
//   Result<sensor_msgs::Range> range = Decode<sensor_msgs::Range>(bytes);
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/messages/schema.h"

namespace gsv::messages {

static_assert(std::endian::native == std::endian::little,
              "little-endian CDR is copied from memory without conversion");

using Bytes = std::vector<std::byte>;

// Appends one message to a buffer. Until the writer is destroyed, the buffer is longer than the
// message.
class CdrWriter {
 public:
  // `out` must outlive the writer. Its content is kept, and the encapsulation header is appended.
  explicit CdrWriter(Bytes& out);
  // Removes the bytes after the message from the buffer.
  ~CdrWriter() { out_.resize(static_cast<std::size_t>(next_ - out_.data())); }
  CdrWriter(const CdrWriter&) = delete;
  CdrWriter& operator=(const CdrWriter&) = delete;

  // Writes a number.
  template <typename Number>
  requires std::is_arithmetic_v<Number>
  void Write(Number value) { WriteBlock(&value, sizeof value, sizeof value); }
  // Writes a string.
  void Write(std::string_view text);
  // Writes the number of elements of a sequence.
  void WriteCount(std::size_t count);

  // Writes `size` bytes of numbers of one size, in their memory representation. Writes nothing, not
  // even padding, if `size` is 0.
  void WriteBlock(const void* data, std::size_t size, std::size_t alignment) {
    if (size > 0) std::memcpy(Extend(size, alignment), data, size);
  }

 private:
  // Extends the message by padding and `size` bytes. Returns the position of these bytes.
  std::byte* Extend(std::size_t size, std::size_t alignment) {
    const std::size_t padding = static_cast<std::size_t>(origin_ - next_) & (alignment - 1);
    if (static_cast<std::size_t>(end_ - next_) < padding + size) Grow(padding + size);
    std::byte* const at = next_ + padding;  // the padding is zero already, see Grow()
    next_ = at + size;
    return at;
  }
  // Makes the buffer longer, so that at least `size` bytes follow the message. New bytes are zero.
  void Grow(std::size_t size);

  Bytes& out_;                   // the buffer to which the writer appends
  std::byte* origin_ = nullptr;  // the position from which alignment is counted
  std::byte* next_ = nullptr;    // the end of the message so far
  std::byte* end_ = nullptr;     // the end of the buffer
};

// Reads one message. The reader fails at the first value that exceeds the message. From then on,
// every read returns zero, an empty string or an empty sequence.
class CdrReader {
 public:
  // `bytes` must outlive the reader.
  explicit CdrReader(std::span<const std::byte> bytes);

  // Reads a number.
  template <typename Number>
  requires std::is_arithmetic_v<Number>
  void Read(Number& value) {
    if constexpr (std::is_same_v<Number, bool>) {
      std::uint8_t byte = 0;
      ReadBlock(&byte, 1, 1);
      value = byte != 0;
    } else {
      value = 0;
      ReadBlock(&value, sizeof value, sizeof value);
    }
  }
  // Reads a string.
  void Read(std::string& text);
  // Reads the count of a sequence whose elements take at least `element_size` bytes each. Returns 0
  // if the message is too short for this count.
  std::size_t ReadCount(std::size_t element_size);
  // Reads `size` bytes of numbers of one type, see CdrWriter::WriteBlock().
  void ReadBlock(void* data, std::size_t size, std::size_t alignment);

  // Returns an error if a value exceeded the message, or if unread bytes remain. Up to three unread
  // bytes are allowed, because some writers add padding.
  base::Status Finish() const;

 private:
  // Makes the reader fail. `what` is the reason, a text that is never deleted.
  void Fail(const char* what);
  std::size_t remaining() const { return bytes_.size() - position_; }

  std::span<const std::byte> bytes_;  // the bytes after the encapsulation header
  std::size_t position_ = 0;
  const char* failure_ = nullptr;  // reason of the first failure; null if there was none
};

// Appends `message` to `out`, with its encapsulation header.
template <typename Message>
void Encode(const Message& message, Bytes& out) {
  CdrWriter writer(out);
  Encode(message, writer);
}

// Decodes the message in `bytes`. If the bytes are invalid, returns kCorrupt with the message's
// type and the position of the error.
template <typename Message>
[[nodiscard]] base::Result<Message> Decode(std::span<const std::byte> bytes) {
  CdrReader reader(bytes);
  base::Result<Message> message(Message{});
  Decode(reader, *message);
  if (base::Status status = reader.Finish(); !status) {
    status.error().where = SchemaOf<Message>().name;
    return base::Fail(std::move(status.error()));
  }
  return message;
}

}  // namespace gsv::messages
