#include "gsv/gateway/api/scenario_json.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/scenario/scenario_json.h"

namespace gsv::gateway {
namespace {

using ScenarioJson = nlohmann::json;

constexpr std::size_t kMaxRobots = 1000;
constexpr double kMaxAngle = 1e3;  // maximum magnitude of an angle in a request, rad

base::Failure<FieldError> Refused(std::string field, std::string sentence) {
  return WrongField(std::move(field), {base::ErrorCode::kInvalidArgument, std::move(sentence)});
}

FieldResult<ScenarioJson> ParseRequestObject(std::string_view body) {
  ScenarioJson json = ScenarioJson::parse(body, nullptr, false);
  if (!json.is_object()) return Refused("", "the body of the request must be a JSON object");
  return json;
}

// Removes a boolean member of a request and returns its value. The member must be removed, because
// the parser of scenarios does not know it.
FieldResult<bool> TakeFlag(ScenarioJson& json, const char* name) {
  const ScenarioJson value = json.value(name, ScenarioJson());
  json.erase(name);
  if (value.is_null()) return false;
  if (!value.is_boolean()) return Refused(name, "expected true or false");
  return value.get<bool>();
}

FieldResult<double> TakeAngle(ScenarioJson& json, const char* name) {
  const ScenarioJson value = json.value(name, ScenarioJson());
  json.erase(name);
  if (value.is_null()) return 0;
  if (!value.is_number() || !(std::abs(value.get<double>()) <= kMaxAngle)) {
    return Refused(name, "expected an angle from -1000 to 1000 rad");
  }
  return value.get<double>();
}

FieldResult<std::string> TakeName(ScenarioJson& json, const char* name) {
  const ScenarioJson value = json.value(name, ScenarioJson());
  json.erase(name);
  if (value.is_null()) return std::string();
  if (!value.is_string()) return Refused(name, "expected a string");
  return value.get<std::string>();
}

// Returns the value, or the first problem as an error.
template <typename T>
FieldResult<T> ValueOrFirstProblem(T value, const base::Problems& problems) {
  if (problems.empty()) return value;
  return Refused(problems.front().where, problems.front().message);
}

FieldResult<void> RefuseWhatIsNotForViewers(const ScenarioJson& json) {
  constexpr std::string_view kKnown[]{"name",    "world",       "mode", "real_time_factor",
                                      "step",    "duration",    "seed", "robots",
                                      "avatars", "pedestrians", "ros2"};
  constexpr std::string_view kFormer = "factor";  // a deprecated name of real_time_factor
  for (const auto& [name, value] : json.items()) {
    if (name != kFormer &&
        std::find(std::begin(kKnown), std::end(kKnown), name) == std::end(kKnown)) {
      std::string sentence = "unknown field; the known fields are:";
      for (const std::string_view known : kKnown) {
        sentence += (known == kKnown[0] ? " " : ", ") + std::string(known);
      }
      return Refused(name.substr(0, 128), sentence + ", record");
    }
  }
  for (const char* list : {"robots", "avatars"}) {
    if (json.contains(list) && json[list].size() > kMaxRobots) {
      return Refused(
          list, "has too many entries; at most " + std::to_string(kMaxRobots) + " are allowed");
    }
  }
  return {};
}

// Checks that each robot has a model. In a scenario file, a robot without a model is a robot of the
// world file. A request to create a simulation cannot refer to such a robot.
FieldResult<void> RequireModels(const scenario::Scenario& scenario) {
  for (std::size_t i = 0; i < scenario.robots.size(); ++i) {
    if (!scenario.robots[i].model.empty()) continue;
    return Refused("robots[" + std::to_string(i) + "].model", "choose a model");
  }
  return {};
}

}  // namespace

FieldResult<SimulationRequest> ParseSimulationRequest(std::string_view body) {
  auto json = ParseRequestObject(body);
  if (!json) return base::Failure{json.error()};
  const auto record = TakeFlag(*json, "record");
  if (!record) return base::Failure{record.error()};
  if (auto ok = RefuseWhatIsNotForViewers(*json); !ok) return base::Failure{ok.error()};
  base::Problems problems;
  auto scenario =
      ValueOrFirstProblem(scenario::ParseScenarioJson(json->dump(), problems), problems);
  if (!scenario) return base::Failure{scenario.error()};
  if (scenario->world.empty()) return Refused("world", "choose a world");
  if (auto ok = RequireModels(*scenario); !ok) return base::Failure{ok.error()};
  return SimulationRequest{*std::move(scenario), *record};
}

FieldResult<RobotToAdd> ParseRobotRequest(std::string_view body) {
  auto json = ParseRequestObject(body);
  if (!json) return base::Failure{json.error()};
  const auto is_avatar = TakeFlag(*json, "avatar");
  if (!is_avatar) return base::Failure{is_avatar.error()};
  // A robot without a model refers to the robot with that name in the world file. A scenario gives
  // such a robot no pose, but a request may.
  const bool is_of_world = !json->contains("model") && json->contains("name");
  if (is_of_world) (*json)["model"] = "the world's";
  base::Problems problems;
  RobotToAdd robot{scenario::ParseRobotJson(json->dump(), *is_avatar, problems), *is_avatar};
  if (is_of_world) robot.robot.model.clear();
  const bool is_named = is_of_world && !robot.robot.name.empty();
  if (problems.empty() && robot.robot.model.empty() && !is_named) {
    return Refused("model", "choose a model");
  }
  return ValueOrFirstProblem(std::move(robot), problems);
}

FieldResult<Placement> ParsePlace(std::string_view body) {
  auto json = ParseRequestObject(body);
  if (!json) return base::Failure{json.error()};
  const auto roll = TakeAngle(*json, "roll");
  if (!roll) return base::Failure{roll.error()};
  const auto pitch = TakeAngle(*json, "pitch");
  if (!pitch) return base::Failure{pitch.error()};
  base::Problems problems;
  const auto place =
      ValueOrFirstProblem(scenario::ParsePlaceJson(json->dump(), problems), problems);
  if (!place) return base::Failure{place.error()};
  // FromRollPitchYaw() also computes the poses of world files. With any other function, zeros could
  // have another sign, so a world that was saved and read again would have another hash.
  return Placement{
      {place->pose().position, geometry::FromRollPitchYaw({*roll, *pitch, place->yaw})},
      !place->z.has_value()};
}

FieldResult<ObjectRequest> ParseObjectRequest(std::string_view body) {
  auto json = ParseRequestObject(body);
  if (!json) return base::Failure{json.error()};
  ObjectRequest object;
  const std::pair<const char*, std::string*> texts[]{
      {"name", &object.name}, {"model", &object.model}, {"copy_of", &object.copy_of}};
  for (const auto& [name, text] : texts) {
    auto taken = TakeName(*json, name);
    if (!taken) return base::Failure{taken.error()};
    *text = *std::move(taken);
  }
  if (object.model.empty() == object.copy_of.empty()) {
    return Refused("model", object.model.empty() ? "give a model, or an object to copy"
                                                 : "give a model or an object to copy, not both");
  }
  if (json->empty()) return object;
  const auto place = ParsePlace(json->dump());
  if (!place) return base::Failure{place.error()};
  object.place = *place;
  return object;
}

}  // namespace gsv::gateway
