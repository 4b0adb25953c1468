// Functions that help to encode sensor readings as messages.
#pragma once

#include <string>
#include <vector>

#include "gsv/messages/cdr.h"
#include "gsv/messages/std_msgs.h"
#include "gsv/messages/time.h"
#include "gsv/sensing/reading.h"

namespace gsv::sensing {

// Returns the header of a message at this simulated time.
inline messages::std_msgs::Header HeaderOf(base::SimTime time, const std::string& frame_id) {
  messages::std_msgs::Header header;
  header.stamp = messages::ToMessage(time);
  header.frame_id = frame_id;
  return header;
}
// Returns the header of a reading's message.
inline messages::std_msgs::Header HeaderOf(const Reading& reading, const std::string& frame_id) {
  return HeaderOf(reading.time, frame_id);
}

// Returns the bytes that `append` appends to the vector that it gets.
template <typename Append>
std::vector<std::uint8_t> Appended(Append append) {
  constexpr std::size_t kMaxKept = std::size_t{1} << 16;  // bytes
  static thread_local messages::Bytes bytes;              // the memory of short messages is reused
  bytes.clear();
  append(bytes);
  const auto* begin = reinterpret_cast<const std::uint8_t*>(bytes.data());
  std::vector<std::uint8_t> encoded(begin, begin + bytes.size());
  if (bytes.capacity() > kMaxKept) messages::Bytes().swap(bytes);
  return encoded;
}

// Returns the message in CDR.
template <typename Message>
std::vector<std::uint8_t> Encoded(const Message& message) {
  return Appended([&](messages::Bytes& bytes) { messages::Encode(message, bytes); });
}

}  // namespace gsv::sensing
