#include "gsv/base/log_text.h"

#include <algorithm>

#include <fmt/format.h>

namespace gsv::base {
namespace {

// Returns the length of the UTF-8 sequence at the start of `text`, or 0 if it is invalid (RFC
// 3629).
std::size_t SequenceLength(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80                     ? 1
                             : first >= 0xC2 && first <= 0xDF ? 2
                             : first >= 0xE0 && first <= 0xEF ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const bool is_overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool is_outside = (first == 0xED && byte(1) > 0x9F) || (first == 0xF4 && byte(1) > 0x8F);
  return is_overlong || is_outside ? 0 : length;
}

void AppendEscaped(unsigned char c, std::string& out) {
  if (c == '\n') {
    out += "\\n";
  } else if (c == '\t') {
    out += "\\t";
  } else if (c == '\r') {
    out += "\\r";
  } else {
    out += fmt::format("\\x{:02x}", c);
  }
}

std::string WithoutSecrets(std::string text, const std::vector<std::string>& secrets) {
  static constexpr std::string_view kHidden = "(hidden)";
  for (const std::string& secret : secrets) {
    for (std::size_t at = text.find(secret); at != std::string::npos;
         at = text.find(secret, at + kHidden.size())) {
      text.replace(at, secret.size(), kHidden);
    }
  }
  return text;
}

}  // namespace

std::string LogLine(std::string_view message, std::size_t max_bytes,
                    const std::vector<std::string>& secrets) {
  // Secrets are replaced before the text is truncated, because half of a secret is also secret.
  const std::string whole = WithoutSecrets(std::string(message), secrets);
  std::string_view rest = whole;
  std::string line;
  while (!rest.empty()) {
    if (line.size() >= max_bytes) return line + fmt::format(" (and {} bytes more)", rest.size());
    const std::size_t length = SequenceLength(rest);
    const auto first = static_cast<unsigned char>(rest[0]);
    // The code points 0x80 to 0x9F are control characters, too.
    const bool is_control =
        first < 0x20 || first == 0x7F ||
        (length == 2 && first == 0xC2 && static_cast<unsigned char>(rest[1]) < 0xA0);
    if (length == 0 || is_control) {
      AppendEscaped(first, line);
      rest.remove_prefix(1);
      if (length == 2) {
        AppendEscaped(static_cast<unsigned char>(rest[0]), line);
        rest.remove_prefix(1);
      }
    } else {
      line += rest.substr(0, length);
      rest.remove_prefix(length);
    }
  }
  return line;
}

std::string JsonText(std::string_view line) {
  std::string text = "\"";
  for (const char c : line) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

}  // namespace gsv::base
