#include "gsv/formats/xacro/macro.h"

namespace gsv::formats::xacro {
namespace {

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// Reads up to a blank that is outside of quotes and braces.
std::string ReadWord(const std::string& text, std::size_t& at) {
  std::string word;
  bool in_quotes = false;
  int braces = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (IsBlank(c) && !in_quotes && braces == 0) break;
    if (c == '\'') in_quotes = !in_quotes;
    if (c == '{' || c == '(') ++braces;
    if ((c == '}' || c == ')') && braces > 0) --braces;
    word += c;
  }
  return word;
}

void SkipBlanks(const std::string& text, std::size_t& at) {
  while (at < text.size() && IsBlank(text[at])) ++at;
}

void ReadDefault(const std::string& word, Parameter& parameter) {
  std::string value = word;
  if (value.starts_with('^')) {
    parameter.is_forwarded = true;
    value.erase(0, value.starts_with("^|") ? 2 : 1);
    if (value.empty()) return;
  }
  parameter.otherwise = value;
}

}  // namespace

std::vector<Parameter> ParseParameters(const std::string& text) {
  std::vector<Parameter> parameters;
  std::size_t at = 0;
  for (SkipBlanks(text, at); at < text.size(); SkipBlanks(text, at)) {
    Parameter parameter;
    while (at < text.size() && !IsBlank(text[at]) && text[at] != '=' && text[at] != ':') {
      parameter.name += text[at++];
    }
    std::size_t sign = at;
    SkipBlanks(text, sign);
    if (sign < text.size() && text[sign] == ':') ++sign;
    if (sign < text.size() && text[sign] == '=') {
      at = sign + 1;
      SkipBlanks(text, at);
      ReadDefault(ReadWord(text, at), parameter);
    } else if (at < text.size() && !IsBlank(text[at])) {
      ++at;  // skips a colon without "="
    }
    for (; parameter.name.starts_with('*'); parameter.name.erase(0, 1)) {
      parameter.kind = parameter.kind == Parameter::Kind::kValue ? Parameter::Kind::kBlock
                                                                 : Parameter::Kind::kChildren;
    }
    if (!parameter.name.empty()) parameters.push_back(std::move(parameter));
  }
  return parameters;
}

}  // namespace gsv::formats::xacro
