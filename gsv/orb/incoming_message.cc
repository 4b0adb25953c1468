#include "gsv/orb/incoming_message.h"

#include <algorithm>
#include <cstring>

namespace gsv::orb {

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
