// Fuzz test: decodes arbitrary bytes as a message. The first byte selects the type of the message.
// The decoder may reject the message. Otherwise, the message must not change when it is encoded and
// decoded again.
#include <cstdint>

#include "gsv/base/check.h"
#include "samples.h"

using namespace gsv;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::byte> bytes = std::as_bytes(std::span(data + 1, size - 1));
  const std::size_t wanted = data[0] % messages::AllSchemas().size();
  std::size_t type = 0;
  messages::ForEachType([&](const messages::Schema&, auto message) {
    if (type++ != wanted) return;
    using Message = decltype(message);
    const auto decoded = messages::Decode<Message>(bytes);
    if (!decoded) {
      GSV_CHECK(!decoded.error().message.empty());
      return;
    }
    messages::Bytes once, twice;
    messages::Encode(*decoded, once);
    const auto again = messages::Decode<Message>(once);
    GSV_CHECK(again.has_value());
    messages::Encode(*again, twice);
    GSV_CHECK(once == twice);  // compares bytes, as NaN is not equal to itself
  });
  return 0;
}
