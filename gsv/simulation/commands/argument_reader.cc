#include "gsv/simulation/commands/argument_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace gsv::simulation {
namespace {

constexpr std::size_t kMaxQuoted = 100;
// Above this value a double cannot represent every integer.
constexpr double kMaxInteger = 9007199254740992;  // 2^53

template <typename Number>
std::optional<Number> NumberIn(const std::string& text) {
  Number number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && rest == end ? std::optional(number) : std::nullopt;
}

// Converts a text to the type of its parameter. A text that does not fit stays a text, which
// ReadArguments() rejects.
ArgumentValue FromText(ParameterType type, const std::string& text) {
  switch (type) {
    case ParameterType::kNumber:
    case ParameterType::kInteger:
      if (const auto integer = NumberIn<std::int64_t>(text)) return *integer;
      if (const auto number = NumberIn<double>(text)) return *number;
      break;
    case ParameterType::kFlag:
      if (text == "true" || text == "false") return text == "true";
      break;
    case ParameterType::kText:
      break;
  }
  return text;
}

// Returns the value converted to the type, or nullopt if it has another type.
std::optional<ArgumentValue> Convert(ParameterType type, const ArgumentValue& value) {
  if (value.index() == static_cast<std::size_t>(type)) return value;
  if (type == ParameterType::kNumber && std::holds_alternative<std::int64_t>(value)) {
    return static_cast<double>(std::get<std::int64_t>(value));
  }
  if (type != ParameterType::kInteger || !std::holds_alternative<double>(value)) return {};
  const double number = std::get<double>(value);
  if (!(std::abs(number) <= kMaxInteger) || number != std::trunc(number)) return {};
  return static_cast<std::int64_t>(number);
}

bool IsInRange(const Parameter& parameter, const ArgumentValue& value) {
  const auto is_within = [&](double number) {
    return std::isfinite(number) && number >= parameter.minimum && number <= parameter.maximum;
  };
  if (const auto* number = std::get_if<double>(&value)) return is_within(*number);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    return is_within(static_cast<double>(*integer));
  }
  return true;
}

std::string Quoted(const ArgumentValue& value) {
  const std::string text = ToText(value);
  return std::holds_alternative<std::string>(value) ? '"' + text.substr(0, kMaxQuoted) + '"' : text;
}

}  // namespace

const char* ToString(ParameterType type) {
  constexpr const char* kNames[]{"number", "integer", "flag", "text"};
  return kNames[static_cast<std::size_t>(type)];
}

std::string ToText(const ArgumentValue& value) {
  return std::visit([](const auto& each) { return fmt::format("{}", each); }, value);
}

std::string DescribeRange(const Parameter& parameter) {
  if (parameter.type == ParameterType::kFlag) return "true or false";
  if (parameter.type == ParameterType::kText) return "a text";
  std::string text = parameter.type == ParameterType::kInteger ? "a whole number" : "a number";
  // Large bounds are written with all digits, such as 1000000000, because this is easier to read.
  if (std::isfinite(parameter.minimum)) text += fmt::format(" from {:.15g}", parameter.minimum);
  if (std::isfinite(parameter.maximum)) text += fmt::format(" to {:.15g}", parameter.maximum);
  if (!parameter.unit.empty()) text += fmt::format(" {}", parameter.unit);
  return text;
}

class ArgumentReader {
 public:
  explicit ArgumentReader(const Command& command) : command_(command) {}

  base::Result<Arguments> Read(Arguments::Values given) const {
    for (const auto& [name, value] : given) {
      if (Find(name) == nullptr) return Unknown(name);
    }
    for (const Parameter& parameter : command_.parameters) {
      auto former = given.extract(std::string(parameter.former_name));
      if (former.empty()) continue;
      former.key() = parameter.name;
      if (!given.insert(std::move(former)).inserted) {
        return Wrong(parameter, fmt::format("must not be set again by its former name '{}'",
                                            parameter.former_name));
      }
    }
    for (const Parameter& parameter : command_.parameters) {
      const auto found = given.find(parameter.name);
      if (found == given.end()) {
        if (parameter.is_required()) return Wrong(parameter, "it is missing");
        if (parameter.default_value) {
          given.emplace(std::string(parameter.name), *parameter.default_value);
        }
        continue;
      }
      auto value = Convert(parameter.type, found->second);
      if (!value || !IsInRange(parameter, *value)) {
        return Wrong(parameter, "it is " + Quoted(found->second));
      }
      found->second = *std::move(value);
    }
    return Arguments(std::move(given));
  }

  Arguments::Values FromTexts(const std::map<std::string, std::string>& texts) const {
    Arguments::Values given;
    for (const auto& [name, text] : texts) {
      const Parameter* const parameter = Find(name);
      given.emplace(name, FromText(parameter ? parameter->type : ParameterType::kText, text));
    }
    return given;
  }

 private:
  const Parameter* Find(std::string_view name) const {
    const auto found = std::find_if(
        command_.parameters.begin(), command_.parameters.end(), [&](const Parameter& each) {
          return !name.empty() && (each.name == name || each.former_name == name);
        });
    return found == command_.parameters.end() ? nullptr : &*found;
  }

  base::Failure<base::Error> Refuse(std::string sentence) const {
    return base::Fail(base::ErrorCode::kInvalidArgument, std::move(sentence),
                      std::string(command_.name));
  }
  base::Failure<base::Error> Unknown(const std::string& name) const {
    std::string known;
    for (const Parameter& parameter : command_.parameters) {
      known += known.empty() ? "; known: " : ", ";
      known += parameter.name;
    }
    return Refuse(fmt::format("there is no parameter '{}'{}", name.substr(0, kMaxQuoted),
                              known.empty() ? "; the command takes no parameters" : known));
  }
  base::Failure<base::Error> Wrong(const Parameter& parameter, const std::string& found) const {
    return Refuse(
        fmt::format("'{}' must be {}, and {}", parameter.name, DescribeRange(parameter), found));
  }

  const Command& command_;
};

base::Result<Arguments> ReadArguments(const Command& command, Arguments::Values given) {
  return ArgumentReader(command).Read(std::move(given));
}

base::Result<Arguments> ReadArguments(const Command& command,
                                      const std::map<std::string, std::string>& given) {
  const ArgumentReader reader(command);
  return reader.Read(reader.FromTexts(given));
}

}  // namespace gsv::simulation
