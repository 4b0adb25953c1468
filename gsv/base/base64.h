// Converts bytes to Base64 text and back (RFC 4648, section 4, with padding).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gsv::base {

std::string ToBase64(std::string_view bytes);

// Decodes the output of ToBase64(). Returns nullopt for any other text.
std::optional<std::string> FromBase64(std::string_view text);

}  // namespace gsv::base
