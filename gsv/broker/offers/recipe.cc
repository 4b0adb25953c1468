#include "gsv/broker/offers/recipe.h"

#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "gsv/broker/offers/dynamic_values.h"

namespace gsv::broker {
namespace {

std::string Quoted(std::string_view text) {
  std::string literal = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') literal.push_back('\\');
    literal.push_back(c);
  }
  return literal + "'";
}

// The shortest text that is parsed as exactly this number.
std::optional<std::string> LiteralOf(double value) {
  if (!std::isfinite(value)) return std::nullopt;
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::optional<std::string> LiteralOf(const Value& value) {
  if (const auto truth = value.AsBoolean()) return *truth ? "TRUE" : "FALSE";
  if (const auto integer = value.AsInteger()) return std::to_string(*integer);
  if (const auto real = value.AsReal()) return LiteralOf(*real);
  if (const auto text = value.AsText()) return Quoted(*text);
  return std::nullopt;
}

// Parses a recipe. Calls `text` for each literal part, `property` for each property name, and
// `constraint` for each `$*`. Returns false if the text is not a recipe, or if a call returns
// false.
bool Read(std::string_view recipe, const std::function<void(std::string_view)>& text,
          const std::function<bool(std::string_view)>& property,
          const std::function<void()>& constraint) {
  while (true) {
    const std::size_t dollar = recipe.find('$');
    text(recipe.substr(0, dollar));
    if (dollar == std::string_view::npos) return true;
    recipe.remove_prefix(dollar + 1);
    if (recipe.empty()) return false;
    const char kind = recipe.front();
    recipe.remove_prefix(1);
    if (kind == '$') {
      text("$");
    } else if (kind == '*') {
      constraint();
    } else {
      const std::size_t end = recipe.find(')');
      if (kind != '(' || end == std::string_view::npos) return false;
      if (!property(recipe.substr(0, end))) return false;
      recipe.remove_prefix(end + 1);
    }
  }
}

bool HasLiterals(const Value& value) {
  if (!IsDynamic(value)) return !value.is_sequence() && value.scalar() != Scalar::kOther;
  const PropertyType& promised = *value.AsOther()->promised_type;
  return !promised.sequence && promised.scalar != Scalar::kOther;
}

}  // namespace

bool IsRecipe(std::string_view recipe, const PropertyList& properties) {
  return Read(
      recipe, [](std::string_view) {},
      [&](std::string_view name) {
        const Value* value = properties.Find(name);
        return value != nullptr && HasLiterals(*value);
      },
      [] {});
}

std::optional<std::string> FollowRecipe(std::string_view recipe, const PropertySource& properties,
                                        std::string_view constraint) {
  std::string result;
  const bool followed = Read(
      recipe, [&](std::string_view text) { result += text; },
      [&](std::string_view name) {
        const Value* value = properties.Find(name);
        const auto literal = value != nullptr ? LiteralOf(*value) : std::nullopt;
        result += literal.value_or("");
        return literal.has_value();
      },
      [&] { result += constraint; });
  return followed ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace gsv::broker
