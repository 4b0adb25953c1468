#include "gsv/orb/giop/message_assembly.h"

#include <algorithm>
#include <utility>

namespace gsv::orb {
namespace {

// Memory is allocated in pieces as bytes arrive, because the declared length may be wrong.
constexpr std::size_t kPiece = 8192;
// If the buffer is larger than this, it is freed before the next message.
constexpr std::size_t kKept = 1024;

constexpr std::size_t kFragmentHeaderBytes = kGiopHeaderBytes + 4;

}  // namespace

MessageAssembly::Room MessageAssembly::Next() {
  const std::size_t size = std::min(wanted_ - received_, kPiece);
  frame_.resize(received_ + size);
  return {frame_.data() + received_, size};
}

void MessageAssembly::Take(std::size_t count) {
  received_ += count;
  frame_.resize(received_);
  if (received_ < wanted_) return;
  if (wanted_ == kGiopHeaderBytes) ReadHeader();
  if (state_ == State::kIncomplete && received_ == wanted_) FinishFrame();
}

void MessageAssembly::ReadHeader() {
  const auto header = ReadGiopHeader(frame_);
  const std::size_t size = header ? kGiopHeaderBytes + header->body_bytes : 0;
  const bool continues = !message_.empty();
  const bool fragment = header && header->type == GiopHeader::kFragment;
  if (!header || fragment != continues || (header->more_fragments && header->minor < 2) ||
      message_.size() + size > limit_) {
    state_ = State::kRefused;
    return;
  }
  wanted_ = size;
}

void MessageAssembly::FinishFrame() {
  const auto header = ReadGiopHeader(frame_);
  base::CdrReader in = ReaderBehind(*header, frame_);
  if (message_.empty()) {
    message_ = std::move(frame_);
    if (header->more_fragments) request_ = in.ULong();
  } else {
    if (in.ULong() != request_ || !in.ok()) {
      state_ = State::kRefused;
      return;
    }
    message_.append(frame_, kFragmentHeaderBytes);
  }
  frame_.clear();
  received_ = 0;
  wanted_ = kGiopHeaderBytes;
  if (header->more_fragments) return;
  CompleteGiopHeader(message_);
  state_ = State::kComplete;
}

void MessageAssembly::Reset() {
  state_ = State::kIncomplete;
  received_ = 0;
  wanted_ = kGiopHeaderBytes;
  frame_.clear();
  message_.clear();
  if (message_.capacity() > kKept) message_.shrink_to_fit();
}

}  // namespace gsv::orb
