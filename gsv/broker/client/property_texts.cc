#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "gsv/broker/client/broker_administration.h"
#include "gsv/broker/language/names.h"

namespace gsv::broker {
namespace {

using base::ErrorCode;
using Json = nlohmann::json;

constexpr std::array<Scalar, 9> kScalars = {Scalar::kBoolean, Scalar::kShort, Scalar::kUShort,
                                            Scalar::kLong,    Scalar::kULong, Scalar::kFloat,
                                            Scalar::kDouble,  Scalar::kChar,  Scalar::kString};

std::optional<PropertyType> TypeOf(std::string_view spelling) {
  for (const Scalar scalar : kScalars) {
    for (const bool sequence : {false, true}) {
      const PropertyType type{.scalar = scalar, .sequence = sequence};
      if (type.Spelling() == spelling) return type;
    }
  }
  return std::nullopt;
}

// Removes `word` and a space from the start of `text`. Returns false if `text` does not start with
// `word` and a space.
bool Take(std::string_view word, std::string_view& text) {
  if (!text.starts_with(word) || text.size() == word.size() || text[word.size()] != ' ') {
    return false;
  }
  text.remove_prefix(word.size() + 1);
  return true;
}

template <typename Integer>
bool Fits(const Json& json) {
  if (!json.is_number_integer()) return false;
  if (json.is_number_unsigned() && json.get<std::uint64_t>() > std::numeric_limits<Integer>::max())
    return false;
  const auto value = json.get<std::int64_t>();
  return value >= std::int64_t{std::numeric_limits<Integer>::min()} &&
         value <= std::int64_t{std::numeric_limits<Integer>::max()};
}

std::optional<ScalarValue> ToScalar(const Json& json, Scalar scalar) {
  switch (scalar) {
    case Scalar::kBoolean:
      return json.is_boolean() ? std::optional<ScalarValue>(json.get<bool>()) : std::nullopt;
    case Scalar::kShort:
      if (!Fits<std::int16_t>(json)) return std::nullopt;
      return json.get<std::int64_t>();
    case Scalar::kUShort:
      if (!Fits<std::uint16_t>(json)) return std::nullopt;
      return json.get<std::int64_t>();
    case Scalar::kLong:
      if (!Fits<std::int32_t>(json)) return std::nullopt;
      return json.get<std::int64_t>();
    case Scalar::kULong:
      if (!Fits<std::uint32_t>(json)) return std::nullopt;
      return json.get<std::int64_t>();
    case Scalar::kFloat:
      if (!json.is_number()) return std::nullopt;
      return static_cast<double>(json.get<float>());
    case Scalar::kDouble:
      if (!json.is_number()) return std::nullopt;
      return json.get<double>();
    case Scalar::kChar:
      if (!json.is_string() || json.get_ref<const std::string&>().size() != 1) return std::nullopt;
      return json.get<std::string>();
    case Scalar::kString:
      if (!json.is_string()) return std::nullopt;
      return json.get<std::string>();
    case Scalar::kOther:
      break;
  }
  return std::nullopt;
}

std::optional<Value> ValueFromJson(const Json& json, const PropertyType& type) {
  if (!type.sequence) {
    const auto content = ToScalar(json, type.scalar);
    if (!content) return std::nullopt;
    return Value::Of(type.scalar, *content);
  }
  if (!json.is_array()) return std::nullopt;
  Value::Sequence elements;
  for (const Json& element : json) {
    const auto content = ToScalar(element, type.scalar);
    if (!content) return std::nullopt;
    elements.push_back(*content);
  }
  return Value::SequenceOf(type.scalar, std::move(elements));
}

PropertyType TypeThatJsonSays(const Json& json) {
  const bool sequence = json.is_array();
  const Json element = sequence && !json.empty() ? json.front() : json;
  Scalar scalar = Scalar::kString;
  if (element.is_boolean()) scalar = Scalar::kBoolean;
  if (element.is_number_integer()) scalar = Scalar::kLong;
  if (element.is_number_float()) scalar = Scalar::kDouble;
  return {.scalar = scalar, .sequence = sequence};
}

}  // namespace

base::Result<PropertyDefinition> ParsePropertyDefinition(const std::string& text) {
  std::string_view rest = text;
  int mode = 0;
  if (Take("mandatory", rest)) mode |= static_cast<int>(PropertyMode::kMandatory);
  if (Take("readonly", rest)) mode |= static_cast<int>(PropertyMode::kReadonly);
  const std::size_t blank = rest.rfind(' ');
  const auto type = blank == std::string_view::npos ? std::nullopt : TypeOf(rest.substr(0, blank));
  if (!type) {
    return base::Fail(
        ErrorCode::kInvalidArgument,
        "a property must have the form [mandatory] [readonly] TYPE NAME, with a type such as "
        "\"double\", \"unsigned long\" or \"sequence<string>\"",
        text);
  }
  return PropertyDefinition{.name = std::string(rest.substr(blank + 1)),
                            .type = *type,
                            .mode = static_cast<PropertyMode>(mode)};
}

base::Result<Property> ParseProperty(const std::string& text, const ServiceType& type) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    return base::Fail(ErrorCode::kInvalidArgument, "a property must have the form NAME=VALUE",
                      text);
  }
  const std::string name = text.substr(0, equals);
  const std::string content = text.substr(equals + 1);
  const auto declared =
      std::find_if(type.properties.begin(), type.properties.end(),
                   [&](const PropertyDefinition& definition) { return definition.name == name; });
  Json json = Json::parse(content, nullptr, false);
  const bool is_text =
      declared != type.properties.end() && !declared->type.sequence &&
      (declared->type.scalar == Scalar::kString || declared->type.scalar == Scalar::kChar);
  if (json.is_discarded() || (is_text && !json.is_string())) json = content;
  const PropertyType expected =
      declared != type.properties.end() ? declared->type : TypeThatJsonSays(json);
  auto value = ValueFromJson(json, expected);
  if (!value) {
    return base::Fail(ErrorCode::kInvalidArgument,
                      fmt::format("the value is not of the type {}", expected.Spelling()), text);
  }
  return Property{name, std::move(*value)};
}

}  // namespace gsv::broker
