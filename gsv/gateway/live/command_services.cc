#include "gsv/gateway/live/command_services.h"

#include <cctype>
#include <cmath>
#include <limits>

#include "gsv/messages/cdr.h"
#include "gsv/simulation/commands/argument_reader.h"

namespace gsv::gateway {
namespace {

using simulation::Arguments;
using simulation::ArgumentValue;
using simulation::Command;
using simulation::ParameterType;

// Maximum size in bytes of an empty request: CDR's encapsulation header, and the octet that ROS 2
// writes for an empty message.
constexpr std::size_t kMaxEmptyBytes = 8;

constexpr const char* kResponse = "bool success\nstring message\n";

// Returns "SetGravity" for "set_gravity".
std::string TypeName(std::string_view name) {
  std::string type;
  bool is_first = true;
  for (const char c : name) {
    if (c != '_') type += is_first ? static_cast<char>(std::toupper(c)) : c;
    is_first = c == '_';
  }
  return type;
}

bool IsUnsigned(const simulation::Parameter& parameter) { return parameter.minimum >= 0; }

const char* FieldType(const simulation::Parameter& parameter) {
  switch (parameter.type) {
    case ParameterType::kNumber:
      return "float64";
    case ParameterType::kInteger:
      return IsUnsigned(parameter) ? "uint64" : "int64";
    case ParameterType::kFlag:
      return "bool";
    case ParameterType::kText:
      return "string";
  }
  return "";
}

// Whether the field has the value that means "use the default".
bool IsAbsent(const simulation::Parameter& parameter, const ArgumentValue& value) {
  if (parameter.is_required()) return false;
  if (const auto* number = std::get_if<double>(&value)) return std::isnan(*number);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    return *integer == 0 && parameter.minimum > 0;
  }
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr && text->empty();
}

std::string DefaultOf(const simulation::Parameter& parameter) {
  if (parameter.is_required() || parameter.type == ParameterType::kFlag) return "";
  const char* const absent = parameter.type == ParameterType::kNumber    ? "NaN"
                             : parameter.type == ParameterType::kInteger ? "0"
                                                                         : "empty";
  if (parameter.type == ParameterType::kInteger && parameter.minimum <= 0) return "";
  return std::string("; ") + absent + ": " +
         (parameter.default_value ? simulation::ToText(*parameter.default_value)
                                  : std::string(parameter.default_meaning));
}

std::string RequestSchema(const Command& command) {
  std::string schema;
  for (const simulation::Parameter& parameter : command.parameters) {
    schema += "# " + std::string(parameter.summary) + ": " + DescribeRange(parameter) +
              DefaultOf(parameter) + "\n";
    schema += std::string(FieldType(parameter)) + " " + std::string(parameter.name) + "\n";
  }
  return schema;
}

foxglove::Service ServiceOf(std::uint32_t id, const Command& command) {
  const std::string type = command.parameters.empty() ? "std_srvs/srv/Trigger"
                                                      : "gsv_msgs/srv/" + TypeName(command.name);
  return {id,
          "/gsv/" + std::string(command.name),
          type,
          {type + "_Request", RequestSchema(command)},
          {type + "_Response", kResponse}};
}

template <typename Field>
Field ReadField(messages::CdrReader& reader) {
  Field field{};
  reader.Read(field);
  return field;
}

ArgumentValue ReadValue(const simulation::Parameter& parameter, messages::CdrReader& reader) {
  switch (parameter.type) {
    case ParameterType::kNumber:
      break;
    case ParameterType::kInteger: {
      if (!IsUnsigned(parameter)) return ReadField<std::int64_t>(reader);
      const auto number = ReadField<std::uint64_t>(reader);
      if (number <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
        return static_cast<std::int64_t>(number);
      }
      return static_cast<double>(number);  // the number is too large for an integer, so it is
                                           // refused later
    }
    case ParameterType::kFlag:
      return ReadField<bool>(reader);
    case ParameterType::kText:
      return ReadField<std::string>(reader);
  }
  return ReadField<double>(reader);
}

base::Result<Arguments> ArgumentsIn(const Command& command, const foxglove::ServiceCall& call) {
  if (command.parameters.empty()) {
    if (call.request.size() <= kMaxEmptyBytes) return ReadArguments(command, Arguments::Values());
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the request of this service must be empty, but it has content");
  }
  messages::CdrReader reader(std::as_bytes(std::span(call.request)));
  Arguments::Values given;
  for (const simulation::Parameter& parameter : command.parameters) {
    ArgumentValue value = ReadValue(parameter, reader);
    if (!IsAbsent(parameter, value)) given.emplace(std::string(parameter.name), std::move(value));
  }
  if (const base::Status whole = reader.Finish(); !whole) return base::Fail(whole.error());
  return ReadArguments(command, std::move(given));
}

CommandServices::Response ResponseTo(const base::Result<std::string>& done) {
  CommandServices::Response bytes;
  {
    messages::CdrWriter writer(bytes);
    writer.Write(done.has_value());
    writer.Write(done ? *done : done.error().Sentence());
  }
  return bytes;
}

}  // namespace

std::vector<foxglove::Service> CommandServices::list() const {
  std::vector<foxglove::Service> list;
  for (const Service& service : services_) {
    list.push_back(ServiceOf(static_cast<std::uint32_t>(list.size() + 1), service.command));
  }
  return list;
}

base::Result<std::function<CommandServices::Response()>> CommandServices::Prepare(
    const foxglove::ServiceCall& call) const {
  if (call.service == 0 || call.service > services_.size()) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "there is no service " + std::to_string(call.service));
  }
  const Service& service = services_[call.service - 1];
  auto arguments = ArgumentsIn(service.command, call);
  if (!arguments) return base::Fail(arguments.error());
  return [run = service.run, given = *std::move(arguments)] { return ResponseTo(run(given)); };
}

}  // namespace gsv::gateway
