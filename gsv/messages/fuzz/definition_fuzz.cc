// Fuzz test: parses arbitrary text, up to a NUL, as the definition of a message type. Decodes the
// bytes after the NUL as a message of that type.
#include <algorithm>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "gsv/base/check.h"
#include "gsv/messages/definition.h"

using namespace gsv;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::uint8_t* const nul = std::find(data, data + size, 0);
  const std::string_view text(reinterpret_cast<const char*>(data),
                              static_cast<std::size_t>(nul - data));
  const auto definition = messages::Definition::Parse("test_msgs/msg/Fuzzed", text);
  if (!definition) {
    GSV_CHECK(!definition.error().message.empty());
    return 0;
  }
  if (nul == data + size) return 0;
  const auto message = definition->Decode(
      std::as_bytes(std::span(nul + 1, static_cast<std::size_t>(data + size - nul - 1))));
  GSV_CHECK(message.has_value() ? message->is_object() : !message.error().message.empty());
  return 0;
}
