#include "gsv/gateway/http/target.h"

#include <cctype>
#include <charconv>
#include <optional>

namespace gsv::gateway {
namespace {

constexpr std::size_t kMaxTargetLength = 4096;

std::optional<std::string> Unescape(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      plain += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    unsigned value = 0;
    const char* end = text.data() + i + 3;
    const auto [stop, error] = std::from_chars(text.data() + i + 1, end, value, 16);
    if (error != std::errc() || stop != end) return std::nullopt;
    plain += static_cast<char>(value);
    i += 2;
  }
  return plain;
}

// Calls use(part) for each part between separators. If a call returns false, stops and returns
// false.
template <typename Use>
bool ForEachPart(std::string_view text, char separator, Use&& use) {
  while (!text.empty()) {
    const std::size_t end = text.find(separator);
    if (!use(text.substr(0, end))) return false;
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return true;
}

bool AddSegment(std::string_view part, Target& target) {
  std::optional<std::string> segment = Unescape(part);
  if (!segment) return false;
  target.segments.push_back(std::move(*segment));
  return true;
}

bool AddQuery(std::string_view part, Target& target) {
  const std::size_t equals = part.find('=');
  std::optional<std::string> name = Unescape(part.substr(0, equals));
  std::optional<std::string> value =
      Unescape(equals == std::string_view::npos ? std::string_view() : part.substr(equals + 1));
  if (!name || !value) return false;
  target.query.insert_or_assign(std::move(*name), std::move(*value));
  return true;
}

}  // namespace

base::Result<Target> ParseTarget(std::string_view target) {
  using base::ErrorCode;
  if (target.size() > kMaxTargetLength) {
    return base::Fail(ErrorCode::kInvalidArgument,
                      "the request's target is longer than 4096 bytes");
  }
  if (target.empty() || target.front() != '/') {
    return base::Fail(ErrorCode::kInvalidArgument, "the request's target does not begin with '/'");
  }
  target = target.substr(1, target.find('#') - 1);
  const std::size_t question = target.find('?');
  const std::string_view query =
      question == std::string_view::npos ? std::string_view() : target.substr(question + 1);
  Target parsed;
  const bool well_formed =
      ForEachPart(target.substr(0, question), '/',
                  [&](std::string_view part) { return AddSegment(part, parsed); }) &&
      ForEachPart(query, '&', [&](std::string_view part) { return AddQuery(part, parsed); });
  if (!well_formed) {
    return base::Fail(ErrorCode::kInvalidArgument,
                      "the request's target has a '%' without two hexadecimal digits after it");
  }
  return parsed;
}

std::string Escape(std::string_view text) {
  static constexpr char kDigits[] = "0123456789ABCDEF";
  std::string escaped;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || c == '-' || c == '.' || c == '_' || c == '~') {
      escaped += c;
    } else {
      escaped += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    }
  }
  return escaped;
}

}  // namespace gsv::gateway
