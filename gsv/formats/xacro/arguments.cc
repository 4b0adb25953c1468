#include "gsv/formats/xacro/arguments.h"

#include <algorithm>
#include <cctype>

namespace gsv::formats::xacro {
namespace {

// Returns the position of the question mark before the arguments; npos if there are none.
std::size_t ArgumentsAt(const std::string& name) {
  constexpr std::size_t kLength = 7;
  const std::size_t at = name.find(".xacro?");
  return at == std::string::npos ? at : at + kLength;
}

std::string Decoded(const std::string& text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_code = text[i] == '%' && i + 2 < text.size() &&
                         std::isxdigit(static_cast<unsigned char>(text[i + 1])) != 0 &&
                         std::isxdigit(static_cast<unsigned char>(text[i + 2])) != 0;
    if (is_code) {
      decoded += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

}  // namespace

NamedFile SplitArguments(const std::string& name) {
  const std::size_t at = ArgumentsAt(name);
  if (at == std::string::npos) return {name, {}};
  NamedFile named{name.substr(0, at - 1), {}};
  for (std::size_t from = at; from <= name.size();) {
    const std::size_t end = std::min(name.find('&', from), name.size());
    const std::string pair = name.substr(from, end - from);
    const std::size_t equals = std::min(pair.find('='), pair.size());
    std::string key = pair.substr(0, equals);
    if (key.ends_with(':')) key.pop_back();  // the notation of xacro itself: name:=value
    if (!key.empty()) {
      named.arguments[Decoded(key)] = Decoded(pair.substr(std::min(equals + 1, pair.size())));
    }
    from = end + 1;
  }
  return named;
}

std::string AsPath(const std::string& name) {
  const std::size_t at = ArgumentsAt(name);
  if (at == std::string::npos) return name;
  std::string path = name.substr(0, at);
  for (const char c : name.substr(at)) path += c == '/' ? std::string("%2F") : std::string(1, c);
  return path;
}

}  // namespace gsv::formats::xacro
