#include "gsv/gateway/api/command_json.h"

#include <string>

#include <nlohmann/json.hpp>

#include "gsv/gateway/live/simulation_commands.h"

namespace gsv::gateway {
namespace {

using Json = nlohmann::json;

tl::unexpected<base::Error> Invalid(std::string sentence) {
  return base::Fail(base::ErrorCode::kInvalidArgument, std::move(sentence));
}

base::Result<Json> ParseObject(std::string_view body) {
  if (body.empty()) return Json::object();
  Json json = Json::parse(body, nullptr, false);
  if (!json.is_object()) return Invalid("the request's body must be a JSON object");
  return json;
}

base::Result<double> NumberOrZero(const Json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end()) return 0.0;
  if (!found->is_number()) return Invalid(std::string("'") + name + "' must be a number");
  return found->get<double>();
}

}  // namespace

base::Result<std::int64_t> ParseStepCount(std::string_view body) {
  const base::Result<Json> json = ParseObject(body);
  if (!json) return base::Fail(json.error());
  const auto count = json->find("count");
  if (count == json->end()) return 1;
  const bool is_valid = count->is_number_unsigned() && count->get<std::uint64_t>() >= 1 &&
                        count->get<std::uint64_t>() <= kMostSteps;
  if (!is_valid) return Invalid("'count' must be a whole number of steps from 1 to 1000000000");
  return count->get<std::int64_t>();
}

base::Result<double> ParseFactor(std::string_view body) {
  const base::Result<Json> json = ParseObject(body);
  if (!json) return base::Fail(json.error());
  const auto factor = json->find("factor");
  if (factor != json->end() && factor->is_number()) return factor->get<double>();
  return Invalid("to set the real-time factor, give {\"factor\": simulated seconds a second}");
}

base::Result<world::DriveCommand> ParseDriveCommand(std::string_view body) {
  const base::Result<Json> json = ParseObject(body);
  if (!json) return base::Fail(json.error());
  world::DriveCommand command;
  const std::pair<const char*, double*> fields[]{{"linear_m_s", &command.linear},
                                                 {"lateral_m_s", &command.lateral},
                                                 {"angular_rad_s", &command.angular}};
  for (const auto& [name, value] : fields) {
    const base::Result<double> number = NumberOrZero(*json, name);
    if (!number) return base::Fail(number.error());
    *value = *number;
  }
  return command;
}

base::Result<bool> ParseRecordingSwitch(std::string_view body) {
  const base::Result<Json> json = ParseObject(body);
  if (!json) return base::Fail(json.error());
  const auto record = json->find("record");
  if (record != json->end() && record->is_boolean()) return record->get<bool>();
  return Invalid("to switch a recording, give {\"record\": true or false}");
}

}  // namespace gsv::gateway
