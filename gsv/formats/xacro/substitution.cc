#include "gsv/formats/xacro/substitution.h"

namespace gsv::formats::xacro {
namespace {

constexpr std::size_t kMaxSubstitutionLength = 1u << 20;
constexpr int kMaxSubstitutionDepth = 8;  // maximum nesting, as in ${…} in $(…) in ${…}

// Returns the position at which the bracket at `open` closes, ignoring strings and inner brackets;
// npos if it does not close.
std::size_t ClosingOf(const std::string& text, std::size_t open) {
  const char opening = text[open], closing = opening == '{' ? '}' : ')';
  int depth = 0;
  char quote = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    const char c = text[i];
    if (quote != 0) {
      if (c == '\\') ++i;
      if (c == quote) quote = 0;
    } else if (opening == '{' && (c == '\'' || c == '"')) {
      quote = c;
    } else if (c == opening) {
      ++depth;
    } else if (c == closing && --depth == 0) {
      return i;
    }
  }
  // If a quote does not end, quotes are ignored: the first closing bracket ends the expression.
  return quote == 0 ? std::string::npos : text.find(closing, open);
}

class Substitution {
 public:
  Substitution(const EvaluationContext& context, const Command& command)
      : context_(context), command_(command) {}

  base::Result<Value> Of(const std::string& text, int depth) {
    if (depth > kMaxSubstitutionDepth)
      return Refuse("${…} and $(…) are nested deeper than 8 levels");
    std::string joined;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t dollar = text.find('$', at);
      joined += text.substr(at, dollar - at);
      if (joined.size() > kMaxSubstitutionLength) return Refuse("a string is longer than 1 MiB");
      if (dollar == std::string::npos) break;
      std::size_t bracket = text.find_first_not_of('$', dollar);
      const bool has_bracket =
          bracket != std::string::npos && (text[bracket] == '{' || text[bracket] == '(');
      if (!has_bracket || bracket - dollar > 1) {
        // Nothing is substituted here. Two or more dollar signs before a bracket are copied without
        // the first of them, and dollar signs without a bracket are copied unchanged.
        if (bracket == std::string::npos) bracket = text.size();
        const std::size_t first = has_bracket ? dollar + 1 : dollar;
        const std::size_t end = has_bracket ? bracket + 1 : bracket;
        joined += text.substr(first, end - first);
        at = end;
        continue;
      }
      const std::size_t end = ClosingOf(text, bracket);
      if (end == std::string::npos) return Refuse("a bracket is not closed in \"" + text + "\"");
      auto value = Bracket(text[bracket], text.substr(bracket + 1, end - bracket - 1), depth);
      if (!value) return value;
      if (dollar == 0 && end + 1 == text.size()) return value;
      joined += ToText(*value);
      at = end + 1;
    }
    return Value{joined};
  }

 private:
  static base::Failure<base::Error> Refuse(const std::string& why) {
    return base::Fail(base::ErrorCode::kBadModel, why);
  }

  base::Result<Value> Bracket(char bracket, const std::string& content, int depth) {
    const auto inner = Of(content, depth + 1);
    if (!inner) return inner;
    const std::string text = ToText(*inner);
    auto value = bracket == '{' ? Evaluate(text, context_) : command_(text);
    if (value) return value;
    base::Error error = value.error();
    if (error.where.empty() && error.message.find(" in ${") == std::string::npos &&
        bracket == '{') {
      error.message += " in ${" + text + "}";
    }
    return base::Fail(error);
  }

  const EvaluationContext& context_;
  const Command& command_;
};

}  // namespace

base::Result<Value> Substitute(const std::string& text, const EvaluationContext& context,
                               const Command& command) {
  return Substitution(context, command).Of(text, 0);
}

}  // namespace gsv::formats::xacro
