#include "gsv/gateway/api/command_json.h"

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "gsv/simulation/commands/argument_reader.h"
#include "gsv/simulation/commands/command_table.h"

namespace gsv::gateway {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

base::Failure<base::Error> Invalid(std::string sentence) {
  return base::Fail(base::ErrorCode::kInvalidArgument, std::move(sentence));
}

base::Result<Json> ParseObject(std::string_view body) {
  if (body.empty()) return Json::object();
  Json json = Json::parse(body, nullptr, false);
  if (!json.is_object()) return Invalid("the body of the request must be a JSON object");
  return json;
}

// Returns the value of an argument. Null, lists and objects are not valid.
base::Result<simulation::ArgumentValue> ValueOf(const std::string& name, const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_string()) return json.get<std::string>();
  const bool is_large = json.is_number_unsigned() && json.get<std::int64_t>() < 0;
  if (json.is_number_integer() && !is_large) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  return Invalid("'" + name.substr(0, 100) + "' must be a number, true, false or a string");
}

Json JsonOf(const simulation::ArgumentValue& value) {
  return std::visit([](const auto& each) { return Json(each); }, value);
}

OrderedJson JsonOf(const simulation::Parameter& parameter) {
  OrderedJson json{{"name", parameter.name},
                   {"type", ToString(parameter.type)},
                   {"unit", parameter.unit},
                   {"summary", parameter.summary},
                   {"required", parameter.is_required()}};
  if (std::isfinite(parameter.minimum)) json["minimum"] = parameter.minimum;
  if (std::isfinite(parameter.maximum)) json["maximum"] = parameter.maximum;
  if (parameter.default_value) json["default"] = JsonOf(*parameter.default_value);
  if (!parameter.default_meaning.empty()) json["default_meaning"] = parameter.default_meaning;
  return json;
}

base::Result<double> NumberOrZero(const Json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end()) return 0.0;
  if (!found->is_number()) return Invalid(std::string("'") + name + "' must be a number");
  return found->get<double>();
}

}  // namespace

base::Result<simulation::Arguments> ParseArguments(const simulation::Command& command,
                                                   std::string_view body) {
  if (command.parameters.empty()) {
    return ReadArguments(command, simulation::Arguments::Values());
  }
  const base::Result<Json> json = ParseObject(body);
  if (!json) return base::Fail(json.error());
  simulation::Arguments::Values given;
  for (const auto& [name, each] : json->items()) {
    auto value = ValueOf(name, each);
    if (!value) return base::Fail(value.error());
    given.emplace(name, *std::move(value));
  }
  return ReadArguments(command, std::move(given));
}

std::string CommandsJson() {
  OrderedJson list = OrderedJson::array();
  for (const simulation::Command& command : simulation::Commands()) {
    OrderedJson parameters = OrderedJson::array();
    for (const simulation::Parameter& each : command.parameters) {
      parameters.push_back(JsonOf(each));
    }
    list.push_back(
        {{"name", command.name}, {"summary", command.summary}, {"parameters", parameters}});
  }
  return list.dump();
}

base::Result<TimedDriveCommand> ParseDriveCommand(std::string_view body) {
  const base::Result<Json> json = ParseObject(body);
  if (!json) return base::Fail(json.error());
  TimedDriveCommand timed;
  world::DriveCommand& command = timed.command;
  const std::pair<const char*, double*> fields[]{{"linear_m_s", &command.linear},
                                                 {"lateral_m_s", &command.lateral},
                                                 {"angular_rad_s", &command.angular}};
  for (const auto& [name, value] : fields) {
    const base::Result<double> number = NumberOrZero(*json, name);
    if (!number) return base::Fail(number.error());
    *value = *number;
  }
  if (!json->contains("timeout_s")) return timed;
  const base::Result<double> timeout = NumberOrZero(*json, "timeout_s");
  if (!timeout || !(*timeout > 0) || *timeout > kMaxDriveTimeout) {
    return Invalid("'timeout_s' must be a number above 0, at most 60");
  }
  timed.timeout = *timeout;
  return timed;
}

base::Result<world::JointCommand> ParseJointCommand(std::string_view body) {
  using Kind = world::JointCommand::Kind;
  const base::Result<Json> json = ParseObject(body);
  if (!json) return base::Fail(json.error());
  const std::pair<const char*, Kind> kinds[]{
      {"position", Kind::kPosition}, {"velocity", Kind::kVelocity}, {"effort", Kind::kEffort}};
  for (const auto& [name, kind] : kinds) {
    const auto value = json->find(name);
    if (value == json->end() || json->size() != 1 || !value->is_number()) continue;
    return world::JointCommand{kind, value->get<double>()};
  }
  return Invalid(
      "the body of the request must be {\"position\": v}, {\"velocity\": v} or {\"effort\": v}");
}

base::Result<bool> ParseRecordingSwitch(std::string_view body) {
  const base::Result<Json> json = ParseObject(body);
  if (!json) return base::Fail(json.error());
  const auto record = json->find("record");
  if (record != json->end() && record->is_boolean()) return record->get<bool>();
  return Invalid("the body of the request must be {\"record\": true} or {\"record\": false}");
}

}  // namespace gsv::gateway
