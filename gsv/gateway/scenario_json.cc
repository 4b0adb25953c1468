#include "gsv/gateway/scenario_json.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

namespace gsv::gateway {
namespace {

using ScenarioJson = nlohmann::json;

constexpr std::size_t kLongestName = 128;
constexpr std::size_t kLongestText = 4096;  // a path, a constraint
constexpr std::size_t kMostRobots = 1000;
constexpr double kFarthest = 1e6;  // m
constexpr double kLongest = 1e9;   // s

// Reads the members of an object; of what is wrong the first is kept.
class MemberReader {
 public:
  // `at` is what stands before the members' names: "", or "robots[1].".
  MemberReader(const ScenarioJson& object, std::string at, std::optional<FieldError>& wrong)
      : object_(object), at_(std::move(at)), wrong_(wrong) {}

  bool Has(const char* name) const { return object_.contains(name); }

  void Refuse(const std::string& name, std::string sentence) {
    if (wrong_) return;
    wrong_ = FieldError{{base::ErrorCode::kInvalidArgument, std::move(sentence)}, at_ + name};
  }

  std::string Text(const char* name, std::size_t longest) {
    const ScenarioJson* value = Find(name);
    if (value == nullptr) return {};
    if (!value->is_string()) return Refuse(name, "a text is expected here"), "";
    std::string text = value->get<std::string>();
    if (text.size() <= longest) return text;
    return Refuse(name, "at most " + std::to_string(longest) + " bytes are expected here"), "";
  }

  // One of two words; the first where there is none.
  bool IsSecond(const char* name, const std::string& first, const std::string& second) {
    if (!Has(name)) return false;
    const std::string text = Text(name, kLongestText);
    if (text != first && text != second) Refuse(name, "expected " + first + " or " + second);
    return text == second;
  }

  double Number(const char* name, double otherwise, double least, double most) {
    const ScenarioJson* value = Find(name);
    if (value == nullptr) return otherwise;
    const double number = value->is_number() ? value->get<double>() : NAN;
    if (number >= least && number <= most) return number;
    char range[64];
    std::snprintf(range, sizeof range, "a number from %g to %g is expected here", least, most);
    return Refuse(name, range), otherwise;
  }

  std::uint64_t Count(const char* name) {
    const ScenarioJson* value = Find(name);
    if (value == nullptr) return 0;
    if (value->is_number_unsigned()) return value->get<std::uint64_t>();
    return Refuse(name, "a whole number from 0 on is expected here"), 0;
  }

  bool Flag(const char* name) {
    const ScenarioJson* value = Find(name);
    if (value == nullptr) return false;
    if (value->is_boolean()) return value->get<bool>();
    return Refuse(name, "expected true or false"), false;
  }

  // Calls `read` with each object of a list, and its place in it.
  template <typename Read>
  void Each(const char* name, const Read& read) {
    const ScenarioJson* list = Find(name);
    if (list == nullptr) return;
    if (!list->is_array()) return Refuse(name, "a list is expected here");
    if (list->size() > kMostRobots) {
      return Refuse(name, "at most " + std::to_string(kMostRobots) + " are expected here");
    }
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string element = std::string(name) + "[" + std::to_string(i) + "]";
      if (!(*list)[i].is_object()) return Refuse(element, "an object is expected here");
      MemberReader reader((*list)[i], at_ + element + ".", wrong_);
      read(reader);
    }
  }

  void RefuseAllBut(std::initializer_list<std::string_view> known) {
    for (const auto& [name, value] : object_.items()) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      return Refuse(name.substr(0, kLongestName), "there is no such field");
    }
  }

 private:
  const ScenarioJson* Find(const char* name) const {
    const auto found = object_.find(name);
    return found == object_.end() || found->is_null() ? nullptr : &*found;
  }

  const ScenarioJson& object_;
  const std::string at_;
  std::optional<FieldError>& wrong_;
};

// Parses an object, lets `read` make of it what it is, and gives that or what is wrong.
template <typename Read>
auto ParseWhole(std::string_view body, const Read& read)
    -> FieldResult<decltype(read(std::declval<MemberReader&>()))> {
  const ScenarioJson json = ScenarioJson::parse(body, nullptr, false);
  if (!json.is_object()) {
    return tl::make_unexpected(FieldError{
        {base::ErrorCode::kInvalidArgument, "the request's body must be a JSON object"}, ""});
  }
  std::optional<FieldError> wrong;
  MemberReader reader(json, "", wrong);
  auto value = read(reader);
  if (wrong) return tl::make_unexpected(*std::move(wrong));
  return value;
}

Place ReadPlace(MemberReader& reader) {
  Place place;
  place.x = reader.Number("x", 0, -kFarthest, kFarthest);
  place.y = reader.Number("y", 0, -kFarthest, kFarthest);
  if (reader.Has("z")) place.z = reader.Number("z", 0, -kFarthest, kFarthest);
  place.yaw = reader.Number("yaw", 0, -kFarthest, kFarthest);
  return place;
}

RobotRequest ReadRobot(MemberReader& reader) {
  RobotRequest robot;
  robot.name = reader.Text("name", kLongestName);
  robot.model = reader.Text("model", kLongestText);
  if (robot.model.empty()) reader.Refuse("model", "choose a model");
  if (reader.Has("x") != reader.Has("y")) {
    reader.Refuse(reader.Has("x") ? "y" : "x", "x and y are given together, or neither");
  }
  const Place place = ReadPlace(reader);
  if (reader.Has("x")) robot.place = place;
  robot.behaviour = reader.Text("behaviour", kLongestText);
  robot.behaviour_constraint = reader.Text("behaviour_constraint", kLongestText);
  if (!robot.behaviour.empty() && !robot.behaviour_constraint.empty()) {
    reader.Refuse("behaviour_constraint",
                  "a behaviour is chosen by name or by constraint, not both");
  }
  if (reader.Has("movement")) {
    robot.movement = reader.IsSecond("movement", "planar", "rigid") ? model::Movement::kRigid
                                                                    : model::Movement::kPlanar;
  }
  return robot;
}

}  // namespace

FieldResult<SimulationRequest> ParseSimulationRequest(std::string_view body) {
  return ParseWhole(body, [](MemberReader& reader) {
    SimulationRequest request;
    reader.RefuseAllBut({"name", "world", "mode", "factor", "step", "duration", "seed", "record",
                         "robots", "avatars"});
    request.name = reader.Text("name", kLongestName);
    request.world = reader.Text("world", kLongestText);
    if (request.world.empty()) reader.Refuse("world", "choose an environment");
    if (reader.IsSecond("mode", "real_time", "lockstep")) {
      request.mode = simulation::Mode::kLockstep;
    }
    request.factor = reader.Number("factor", 1, 1e-6, 1e6);
    request.step = reader.Number("step", 0, 0, 10);
    if (request.step != 0 && request.step < 1e-6) {
      reader.Refuse("step", "a step takes 1 microsecond at least, or 0 for the world's");
    }
    request.duration = reader.Number("duration", 0, 0, kLongest);
    request.seed = reader.Count("seed");
    request.record = reader.Flag("record");
    reader.Each("robots", [&](MemberReader& robot) {
      robot.RefuseAllBut(
          {"name", "model", "x", "y", "z", "yaw", "behaviour", "behaviour_constraint", "movement"});
      request.robots.push_back(ReadRobot(robot));
    });
    reader.Each("avatars", [&](MemberReader& avatar) {
      avatar.RefuseAllBut({"name", "model", "x", "y", "z", "yaw"});
      request.avatars.push_back(ReadRobot(avatar));
    });
    return request;
  });
}

FieldResult<RobotToAdd> ParseRobotRequest(std::string_view body) {
  return ParseWhole(body, [](MemberReader& reader) {
    reader.RefuseAllBut({"name", "model", "x", "y", "z", "yaw", "behaviour", "behaviour_constraint",
                         "movement", "avatar"});
    RobotToAdd robot{ReadRobot(reader)};
    robot.is_avatar = reader.Flag("avatar");
    return robot;
  });
}

FieldResult<Place> ParsePlace(std::string_view body) {
  return ParseWhole(body, [](MemberReader& reader) {
    reader.RefuseAllBut({"x", "y", "z", "yaw"});
    for (const char* needed : {"x", "y"}) {
      if (!reader.Has(needed)) reader.Refuse(needed, "it is needed");
    }
    return ReadPlace(reader);
  });
}

}  // namespace gsv::gateway
