// Writes scenarios as YAML.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <string_view>

#include "gsv/scenario/scenario_file.h"
#include "gsv/scenario/test_keys.h"

namespace gsv::scenario {
namespace {

bool IsPlainCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("_./-+").find(c) != std::string_view::npos;
}

// Whether a YAML reader would take the text for another type, such as a number.
bool IsReserved(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* word : {"true", "false", "yes", "no", "on", "off", "null", "y", "n"}) {
    if (text == word) return true;
  }
  return false;
}

std::string Text(const std::string& text) {
  const bool begins_plainly =
      !text.empty() && (std::isalpha(static_cast<unsigned char>(text.front())) != 0 ||
                        text.front() == '/' || text.front() == '_');
  if (begins_plainly && !IsReserved(text) &&
      std::all_of(text.begin(), text.end(), IsPlainCharacter)) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (byte < 0x20 || byte == 0x7f) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\x%02x", byte);
      quoted += escape;
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

// Returns the shortest text that is read back as the same number.
std::string Number(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string List(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + Text(text);
  return "[" + list + "]";
}

class Writer {
 public:
  void Put(const char* key, const std::string& value) {
    yaml_ += std::string(key) + ": " + value + "\n";
  }
  void PutText(const char* key, const std::string& value) {
    if (!value.empty()) Put(key, Text(value));
  }
  void PutNumber(const char* key, const std::optional<double>& value) {
    if (value) Put(key, Number(*value));
  }
  void PutChoice(const char* key, const std::optional<bool>& value, const char* no,
                 const char* yes) {
    if (value) Put(key, *value ? yes : no);
  }
  void PutRobots(const char* key, const std::vector<RobotEntry>& robots) {
    if (robots.empty()) return;
    yaml_ += std::string(key) + ":\n";
    for (const RobotEntry& robot : robots) yaml_ += "  - {" + Fields(robot) + "}\n";
  }
  void PutPedestrians(const std::vector<model::PedestrianGroup>& groups) {
    if (groups.empty()) return;
    yaml_ += "pedestrians:\n";
    for (const model::PedestrianGroup& group : groups) yaml_ += "  - {" + Fields(group) + "}\n";
  }
  void PutFaults(const std::vector<Fault>& faults) {
    if (faults.empty()) return;
    yaml_ += "faults:\n";
    for (const Fault& fault : faults) yaml_ += "  - {" + Fields(fault) + "}\n";
  }
  void PutExpectations(const std::vector<Expectation>& expectations) {
    if (expectations.empty()) return;
    yaml_ += "expect:\n";
    for (const Expectation& expectation : expectations) yaml_ += "  - " + expectation.yaml + "\n";
  }
  std::string Take() { return std::move(yaml_); }

 private:
  static std::string Fields(const RobotEntry& robot) {
    std::string fields;
    const auto add = [&](const char* key, const std::string& value) {
      fields += (fields.empty() ? "" : ", ") + std::string(key) + ": " + value;
    };
    if (!robot.name.empty()) add("name", Text(robot.name));
    if (!robot.model.empty()) add("model", Text(robot.model));
    if (robot.start) {
      add("x", Number(robot.start->x));
      add("y", Number(robot.start->y));
      if (robot.start->z) add("z", Number(*robot.start->z));
      add("yaw", Number(robot.start->yaw));
    }
    if (!robot.behaviour.empty()) add("behaviour", Text(robot.behaviour));
    if (!robot.behaviour_constraint.empty()) {
      add("behaviour_constraint", Text(robot.behaviour_constraint));
    }
    if (robot.movement) {
      add("movement", *robot.movement == model::Movement::kRigid ? "rigid" : "planar");
    }
    if (!robot.drive.empty()) add("drive", Text(robot.drive));
    return fields;
  }

  static std::string Fields(const model::PedestrianGroup& group) {
    std::string route;
    for (const model::PedestrianGoal& goal : group.route) {
      route += std::string(route.empty() ? "" : ", ") + "{x: " + Number(goal.x) +
               ", y: " + Number(goal.y) + ", radius: " + Number(goal.radius) + "}";
    }
    return "name: " + Text(group.name) + ", count: " + std::to_string(group.count) + ", route: [" +
           route + "], z: " + Number(group.z) + ", speed: " + Number(group.speed) +
           ", speed_deviation: " + Number(group.speed_deviation) +
           ", radius: " + Number(group.radius) + ", height: " + Number(group.height);
  }

  static std::string Fields(const Fault& fault) {
    using Kind = Fault::Kind;
    const std::string part = fault.part.empty() ? "" : "/" + fault.part;
    const auto subject = [&](const char* key) {
      return "at: " + Number(fault.at) + ", " + key + ": " + Text(fault.body + part);
    };
    switch (fault.kind) {
      case Kind::kSensorSilent:
        return subject("sensor");
      case Kind::kSensorError:
        return subject("sensor") + ", fails: error";
      case Kind::kBehaviourDies:
        return subject("behaviour");
      case Kind::kMotorFails:
        return subject("motor");
      case Kind::kBodyMoves: {
        const Place& place = fault.place;
        const std::string z = place.z ? ", z: " + Number(*place.z) : "";
        return subject("move") + ", x: " + Number(place.x) + ", y: " + Number(place.y) + z +
               ", yaw: " + Number(place.yaw);
      }
      case Kind::kJointMoves:
        break;
    }
    const char* const units[]{"position", "velocity", "effort"};
    return subject("joint") + ", " + units[static_cast<int>(fault.unit)] + ": " +
           Number(fault.target);
  }

  std::string yaml_;
};

std::string Rates(const std::map<std::string, double>& rates) {
  std::string list;
  for (const auto& [kind, rate] : rates) {
    list += (list.empty() ? "" : ", ") + Text(kind) + ": " + Number(rate);
  }
  return "{" + list + "}";
}

std::string Fields(const Ros2Settings& settings) {
  std::string fields, robots;
  const auto add = [](std::string& list, const std::string& key, const std::string& value) {
    list += (list.empty() ? "" : ", ") + key + ": " + value;
  };
  if (!settings.range.empty()) add(fields, "range", settings.range);
  if (!settings.cmd_vel.empty()) add(fields, "cmd_vel", settings.cmd_vel);
  if (!settings.distro.empty()) add(fields, "distro", settings.distro);
  for (const auto& [robot, name_space] : settings.namespaces) {
    add(robots, Text(robot), Text(name_space));
  }
  if (!robots.empty()) add(fields, "namespaces", "{" + robots + "}");
  return fields.empty() ? "true" : "{" + fields + "}";
}

}  // namespace

std::string OneLineYaml(const YAML::Node& node) {
  if (node.IsScalar()) {
    // A text that looks like a number keeps its quotes. Without them, it would be read as a number.
    const bool is_number = node.Tag() != "!" && ParseNumber(node.Scalar());
    return is_number ? node.Scalar() : Text(node.Scalar());
  }
  std::string list;
  for (const auto& entry : node) {
    if (!list.empty()) list += ", ";
    list +=
        node.IsMap() ? entry.first.Scalar() + ": " + OneLineYaml(entry.second) : OneLineYaml(entry);
  }
  if (node.IsMap()) return "{" + list + "}";
  return node.IsSequence() ? "[" + list + "]" : "~";
}

std::string ToYaml(const Scenario& scenario) {
  Writer writer;
  writer.PutText("world", scenario.world);
  writer.PutText("name", scenario.name);
  if (scenario.seed) writer.Put("seed", std::to_string(*scenario.seed));
  writer.PutChoice("mode", scenario.lockstep, "real_time", "lockstep");
  writer.PutNumber("real_time_factor", scenario.factor);
  writer.PutNumber("step", scenario.step);
  writer.PutNumber("duration", scenario.duration);
  writer.PutNumber("deadline", scenario.deadline);
  writer.PutNumber("stuck_after", scenario.stuck_after);
  writer.PutChoice("on_failure", scenario.fails_with_behaviour, "go_on", "fail");
  writer.PutChoice("in_process", scenario.in_process, "false", "true");
  if (!scenario.model_path.empty()) writer.Put("model_path", List(scenario.model_path));
  writer.PutRobots("robots", scenario.robots);
  writer.PutRobots("avatars", scenario.avatars);
  writer.PutPedestrians(scenario.pedestrians);
  writer.PutText("record", scenario.record);
  if (!scenario.record_topics.empty()) writer.Put("record_topics", List(scenario.record_topics));
  if (!scenario.record_rates.empty()) writer.Put("record_rates", Rates(scenario.record_rates));
  writer.PutChoice("record_pictures", scenario.record_png, "jpeg", "png");
  if (scenario.ros2) writer.Put("ros2", Fields(*scenario.ros2));
  writer.PutFaults(scenario.faults);
  writer.PutExpectations(scenario.expect);
  const std::string yaml = writer.Take();
  return yaml.empty() ? "{}\n" : yaml;  // an empty text would not be a mapping
}

}  // namespace gsv::scenario
