#include "gsv/ros2/types/type_description.h"

#include <charconv>
#include <optional>
#include <sstream>
#include <utility>

#include "gsv/base/named.h"
#include "gsv/messages/service_msgs.h"

namespace gsv::ros2 {
namespace {

constexpr std::uint8_t kNested = 1, kString = 17, kBoundedString = 21;
// One of these constants is added to the id of the element type of an array or a sequence.
constexpr std::uint8_t kArray = 48, kBoundedSequence = 96, kSequence = 144;
constexpr std::string_view kSeparator = "\n====";
constexpr std::string_view kNextType = "MSG: ";

base::Failure<base::Error> NoType(std::string message, std::string_view where) {
  return base::Fail(base::ErrorCode::kCorrupt, std::move(message), std::string(where));
}

// Returns "geometry_msgs/msg/Vector3" for "geometry_msgs/Vector3". For "Vector3", `package` is
// used.
std::string FullTypeName(std::string_view type, std::string_view package) {
  const std::size_t slash = type.find('/');
  if (slash == std::string_view::npos) return std::string(package) + "/msg/" + std::string(type);
  if (type.find('/', slash + 1) != std::string_view::npos) return std::string(type);
  return std::string(type.substr(0, slash)) + "/msg" + std::string(type.substr(slash));
}

std::optional<std::uint64_t> NumberIn(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// Parses the brackets at the end of a type: "[]", "[9]", "[<=9]".
bool SetShape(std::string_view brackets, FieldType& type) {
  if (brackets.empty()) return true;
  if (brackets.back() != ']') return false;
  std::string_view length = brackets.substr(1, brackets.size() - 2);
  if (length.empty()) {
    type.id = static_cast<std::uint8_t>(type.id + kSequence);
    return true;
  }
  const bool is_bounded = length.starts_with("<=");
  const auto capacity = NumberIn(length.substr(is_bounded ? 2 : 0));
  if (!capacity) return false;
  type.id = static_cast<std::uint8_t>(type.id + (is_bounded ? kBoundedSequence : kArray));
  type.capacity = *capacity;
  return true;
}

// Parses the type of a field as in a definition: "float64[36]", "string<=10", "Vector3[]".
std::optional<FieldType> ParseFieldType(std::string_view text, std::string_view package) {
  static constexpr base::Named<std::uint8_t> kIds[] = {{"int8", 2},        {"uint8", 3},
                                                       {"int16", 4},       {"uint16", 5},
                                                       {"int32", 6},       {"uint32", 7},
                                                       {"int64", 8},       {"uint64", 9},
                                                       {"float32", 10},    {"float64", 11},
                                                       {"char", 3},  // rosidl treats char as uint8
                                                       {"bool", 15},       {"byte", 16},
                                                       {"string", kString}};
  const std::size_t bracket = std::min(text.find('['), text.size());
  std::string_view value = text.substr(0, bracket);
  FieldType type;
  if (value.starts_with("string<=")) {
    const auto capacity = NumberIn(value.substr(8));
    if (!capacity) return std::nullopt;
    type.id = kBoundedString;
    type.string_capacity = *capacity;
  } else if (const std::uint8_t* known = base::FindNamed(kIds, value)) {
    type.id = *known;
  } else {
    type.id = kNested;
    type.nested_type = FullTypeName(value, package);
  }
  if (!SetShape(text.substr(bracket), type)) return std::nullopt;
  return type;
}

base::Result<Fields> ParseFields(std::string_view name, std::string_view text) {
  const std::string_view package = name.substr(0, name.find('/'));
  Fields fields;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string type_text, field, more;
    if (!(words >> type_text)) continue;
    if (!(words >> field)) return NoType("expected a type and a name, found '" + line + "'", name);
    const bool is_constant =
        field.find('=') != std::string::npos || (words >> more && more.front() == '=');
    if (is_constant) continue;
    auto type = ParseFieldType(type_text, package);
    if (!type) return NoType("expected a type, found '" + type_text + "'", name);
    fields.push_back({std::move(field), *std::move(type)});
  }
  return fields;
}

// Fails if a field has a type that is not defined.
base::Status CheckReferences(const TypeDescription& description, const Fields& fields) {
  for (const FieldDescription& field : fields) {
    if (!field.type.nested_type.empty() &&
        !description.referenced.contains(field.type.nested_type)) {
      return NoType("the definition lacks the type " + field.type.nested_type, description.name);
    }
  }
  return {};
}

void AppendType(const std::string& name, const Fields& fields, std::string& out) {
  out += "{\"type_name\": \"" + name + "\", \"fields\": [";
  const char* separator = "";
  for (const FieldDescription& field : fields) {
    out += separator;
    out += "{\"name\": \"" + field.name +
           "\", \"type\": {\"type_id\": " + std::to_string(field.type.id) +
           ", \"capacity\": " + std::to_string(field.type.capacity) +
           ", \"string_capacity\": " + std::to_string(field.type.string_capacity) +
           ", \"nested_type_name\": \"" + field.type.nested_type + "\"}}";
    separator = ", ";
  }
  out += "]}";
}

void AddReferenced(TypeDescription description, TypeDescription& to) {
  to.referenced.insert(description.referenced.begin(), description.referenced.end());
  to.referenced.emplace(std::move(description.name), std::move(description.fields));
}

}  // namespace

base::Result<TypeDescription> DescribeType(const messages::Schema& schema) {
  TypeDescription description;
  description.name = std::string(schema.name);
  std::string_view rest = schema.text;
  std::string name = description.name;
  while (true) {
    const std::size_t end = std::min(rest.find(kSeparator), rest.size());
    auto fields = ParseFields(name, rest.substr(0, end));
    if (!fields) return base::Fail(fields.error());
    (name == description.name ? description.fields : description.referenced[name]) =
        *std::move(fields);
    const std::size_t next = rest.find(kNextType, end);
    if (end == rest.size() || next == std::string_view::npos) break;
    rest.remove_prefix(next + kNextType.size());
    const std::size_t line_end = std::min(rest.find('\n'), rest.size());
    name = FullTypeName(rest.substr(0, line_end), {});
    rest.remove_prefix(std::min(line_end + 1, rest.size()));
  }
  if (auto status = CheckReferences(description, description.fields); !status) {
    return base::Fail(status.error());
  }
  for (const auto& [type, fields] : description.referenced) {
    if (auto status = CheckReferences(description, fields); !status)
      return base::Fail(status.error());
  }
  return description;
}

base::Result<TypeDescription> DescribeService(std::string_view name,
                                              const messages::Schema& request,
                                              const messages::Schema& response) {
  auto request_type = DescribeType(request);
  if (!request_type) return request_type;
  auto response_type = DescribeType(response);
  if (!response_type) return response_type;
  auto info = DescribeType(messages::SchemaOf<messages::service_msgs::ServiceEventInfo>());
  if (!info) return info;
  const FieldType of_request{kNested, 0, 0, request_type->name};
  const FieldType of_response{kNested, 0, 0, response_type->name};
  const auto at_most_one = [](FieldType type) {
    type.id = static_cast<std::uint8_t>(type.id + kBoundedSequence);
    type.capacity = 1;
    return type;
  };
  TypeDescription description;
  description.name = std::string(name);
  const std::string event = description.name + "_Event";
  description.fields = {{"request_message", of_request},
                        {"response_message", of_response},
                        {"event_message", {kNested, 0, 0, event}}};
  description.referenced[event] = {{"info", {kNested, 0, 0, info->name}},
                                   {"request", at_most_one(of_request)},
                                   {"response", at_most_one(of_response)}};
  AddReferenced(*std::move(info), description);
  AddReferenced(*std::move(request_type), description);
  AddReferenced(*std::move(response_type), description);
  return description;
}

std::string CanonicalJson(const TypeDescription& description) {
  std::string json = "{\"type_description\": ";
  AppendType(description.name, description.fields, json);
  json += ", \"referenced_type_descriptions\": [";
  const char* separator = "";
  for (const auto& [name, fields] : description.referenced) {
    json += separator;
    AppendType(name, fields, json);
    separator = ", ";
  }
  return json + "]}";
}

}  // namespace gsv::ros2
