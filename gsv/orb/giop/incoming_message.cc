#include "gsv/orb/giop/incoming_message.h"

#include <algorithm>
#include <cstring>

#include "gsv/orb/giop/giop_header.h"

namespace gsv::orb {

bool IncomingMessage::IsReady() {
  if (assembly_.state() == MessageAssembly::State::kIncomplete) return false;
  if (assembly_.state() == MessageAssembly::State::kRefused) return true;
  if (ReadGiopHeader(assembly_.message())->type != GiopHeader::kCancelRequest) return true;
  assembly_.Reset();
  return false;
}

int IncomingMessage::HandOut(void* buffer, std::size_t size) {
  if (assembly_.state() == MessageAssembly::State::kRefused) return -1;
  const std::string& message = assembly_.message();
  const std::size_t count = std::min(size, message.size() - handed_out_);
  std::memcpy(buffer, message.data() + handed_out_, count);
  handed_out_ += count;
  if (handed_out_ == message.size()) {
    assembly_.Reset();
    handed_out_ = 0;
  }
  return static_cast<int>(count);
}

}  // namespace gsv::orb
