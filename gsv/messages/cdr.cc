#include "gsv/messages/cdr.h"

#include <algorithm>
#include <limits>

#include "gsv/base/check.h"

namespace gsv::messages {
namespace {

constexpr std::array<std::byte, 4> kEncapsulation{std::byte{0}, std::byte{1}, std::byte{0},
                                                  std::byte{0}};

// The minimum number of bytes by which a writer extends its buffer. Most messages are shorter.
constexpr std::size_t kReserve = 200;

// Fast DDS rounds the size of a message up to a multiple of four, so up to three bytes may follow.
constexpr std::size_t kMaxTrailingBytes = 3;

}  // namespace

CdrWriter::CdrWriter(Bytes& out) : out_(out) {
  const std::size_t begin = out_.size();
  out_.resize(begin + kEncapsulation.size() + kReserve);
  std::memcpy(out_.data() + begin, kEncapsulation.data(), kEncapsulation.size());
  origin_ = next_ = out_.data() + begin + kEncapsulation.size();
  end_ = out_.data() + out_.size();
}

// The added size grows with the message, so that long messages are rarely moved.
void CdrWriter::Grow(std::size_t size) {
  const std::byte* const begin = out_.data();
  const auto origin = static_cast<std::size_t>(origin_ - begin);
  const auto used = static_cast<std::size_t>(next_ - begin);
  out_.resize(used + size + std::max(kReserve, used - origin));
  origin_ = out_.data() + origin;
  next_ = out_.data() + used;
  end_ = out_.data() + out_.size();
}

void CdrWriter::WriteCount(std::size_t count) {
  GSV_CHECK(count <= std::numeric_limits<std::uint32_t>::max());
  Write(static_cast<std::uint32_t>(count));
}

void CdrWriter::Write(std::string_view text) {
  WriteCount(text.size() + 1);
  std::byte* const at = Extend(text.size() + 1, 1);
  if (!text.empty()) std::memcpy(at, text.data(), text.size());
  at[text.size()] = std::byte{0};
}

CdrReader::CdrReader(std::span<const std::byte> bytes) {
  if (bytes.size() < kEncapsulation.size()) {
    Fail("expected a CDR encapsulation header of four bytes");
    return;
  }
  bytes_ = bytes.subspan(kEncapsulation.size());
  // The last two bytes of the header are options, which do not affect reading.
  if (bytes[0] != kEncapsulation[0] || bytes[1] != kEncapsulation[1]) {
    Fail("expected little-endian CDR (encapsulation 00 01)");
  }
}

void CdrReader::Fail(const char* what) {
  if (failure_ == nullptr) failure_ = what;
}

void CdrReader::ReadBlock(void* data, std::size_t size, std::size_t alignment) {
  if (failure_ != nullptr || size == 0) return;
  const std::size_t padding = (0 - position_) & (alignment - 1);
  if (padding > remaining() || size > remaining() - padding) {
    Fail("the message ends in the middle of a field");
    return;
  }
  std::memcpy(data, bytes_.data() + position_ + padding, size);
  position_ += padding + size;
}

std::size_t CdrReader::ReadCount(std::size_t element_size) {
  std::uint32_t count = 0;
  Read(count);
  if (count > remaining() / element_size) {
    Fail("a sequence claims more elements than the message has room for");
  }
  return failure_ == nullptr ? count : 0;
}

void CdrReader::Read(std::string& text) {
  text.clear();
  const std::size_t size = ReadCount(1);
  // A size of 0 is accepted, because some writers send an empty string without its NUL.
  if (size == 0) return;
  text.assign(reinterpret_cast<const char*>(bytes_.data() + position_), size - 1);
  if (bytes_[position_ + size - 1] != std::byte{0}) Fail("a string does not end in NUL");
  position_ += size;
}

base::Status CdrReader::Finish() const {
  const char* failure = failure_;
  if (failure == nullptr && remaining() > kMaxTrailingBytes) {
    failure = "the message is longer than its type allows";
  }
  if (failure == nullptr) return {};
  return base::Fail(base::ErrorCode::kCorrupt,
                    std::string(failure) + ", at byte " + std::to_string(position_) + " of " +
                        std::to_string(bytes_.size()) + " after the header");
}

}  // namespace gsv::messages
