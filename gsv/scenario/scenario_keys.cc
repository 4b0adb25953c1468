#include "gsv/scenario/scenario_keys.h"

#include "gsv/model/drive_choice.h"
#include "gsv/model/real_time_factor.h"
#include "gsv/scenario/test_keys.h"

namespace gsv::scenario {
namespace {

constexpr std::size_t kMaxRobots = 100'000;
constexpr std::size_t kMaxGroups = 1000, kMaxGoals = 1000;
constexpr double kMinRealTimeFactor = 1e-6;
constexpr double kMinStep = 1e-6;                      // s
constexpr double kMinRate = 0.001, kMaxRate = 10'000;  // Hz

std::optional<model::Movement> ReadMovement(YamlMapping& mapping) {
  const auto is_rigid = mapping.IsSecondOf("movement", "planar", "rigid");
  if (!is_rigid) return std::nullopt;
  return *is_rigid ? model::Movement::kRigid : model::Movement::kPlanar;
}

std::string ReadDrive(YamlMapping& mapping) {
  const std::string drive = mapping.Text("drive").value_or("");
  if (drive.empty()) return {};
  const auto choice = model::ParseDriveChoice(drive);
  if (choice) return drive;
  mapping.AddProblem("drive", choice.error().message);
  return {};
}

void CheckRobot(const RobotEntry& robot, bool is_avatar, const YamlMapping& mapping) {
  if (!robot.behaviour.empty() && !robot.behaviour_constraint.empty()) {
    mapping.AddProblem("behaviour_constraint",
                       "choose a behaviour by name or by constraint, not by both");
  }
  if (!mapping.is_mapping() || !robot.model.empty()) return;
  if (is_avatar) {
    mapping.AddProblem("model", "an avatar needs a model");
  } else if (robot.name.empty()) {
    mapping.AddProblem("model", "a robot needs a model, or the name of a robot in the world file");
  } else if (robot.start || robot.movement) {
    mapping.AddProblem("model",
                       "a robot without a model is in the world file, which defines where it "
                       "starts and how it moves");
  }
}

std::vector<RobotEntry> ReadRobots(YamlMapping& mapping, const std::string& key) {
  const bool are_avatars = key == "avatars";
  std::vector<RobotEntry> robots;
  mapping.Each(key, kMaxRobots, [&](const YAML::Node& node, std::string field) {
    YamlMapping robot(node, std::move(field), mapping.place());
    robots.push_back(ReadRobotKeys(robot, are_avatars));
  });
  return robots;
}

std::vector<model::PedestrianGoal> ReadRoute(YamlMapping& mapping) {
  std::vector<model::PedestrianGoal> route;
  mapping.Each("route", kMaxGoals, [&](const YAML::Node& node, std::string field) {
    YamlMapping goal(node, std::move(field), mapping.place());
    const auto x = goal.Number("x", -kMaxCoordinate, kMaxCoordinate);
    const auto y = goal.Number("y", -kMaxCoordinate, kMaxCoordinate);
    const double radius = goal.Number("radius", 0, kMaxCoordinate).value_or(0);
    if (!goal.Has("x") || !goal.Has("y")) goal.AddProblem("a goal needs both x and y");
    if (x && y) route.push_back({*x, *y, radius});
  });
  return route;
}

std::vector<model::PedestrianGroup> ReadPedestrianGroups(YamlMapping& mapping) {
  std::vector<model::PedestrianGroup> groups;
  mapping.Each("pedestrians", kMaxGroups, [&](const YAML::Node& node, std::string field) {
    YamlMapping keys(node, std::move(field), mapping.place());
    const std::size_t problem_count = mapping.place().problem_count();
    model::PedestrianGroup group;
    group.name = keys.Text("name").value_or(group.name);
    group.count = static_cast<int>(
        std::min<std::uint64_t>(keys.Count("count").value_or(1), model::kMaxPedestrians + 1));
    group.route = ReadRoute(keys);
    group.z = keys.Number("z", -kMaxCoordinate, kMaxCoordinate).value_or(group.z);
    group.speed = keys.Number("speed", 0.01, 10).value_or(group.speed);
    group.speed_deviation = keys.Number("speed_deviation", 0, 5).value_or(group.speed_deviation);
    group.radius = keys.Number("radius", 0.05, 1).value_or(group.radius);
    group.height = keys.Number("height", 0.2, 3).value_or(group.height);
    const auto ok = model::Check(group);
    // Reports that the group is invalid, unless a problem of its keys has been reported already.
    if (!ok && mapping.place().problem_count() == problem_count && keys.is_mapping()) {
      keys.AddProblem(ok.error().message);
    }
    groups.push_back(std::move(group));
  });
  return groups;
}

std::map<std::string, double> ReadRates(YamlMapping& mapping) {
  std::map<std::string, double> rates;
  const auto node = mapping.Any("record_rates");
  if (!node) return rates;
  YamlMapping kinds(*node, mapping.FieldOf("record_rates"), mapping.place());
  for (const char* kind : {"poses", "readings", "pictures", "beams"}) {
    if (const auto rate = kinds.Number(kind, kMinRate, kMaxRate)) rates[kind] = *rate;
  }
  return rates;
}

// Returns the value, which must be one of these words. Returns an empty text if the key is absent.
std::string ReadWord(YamlMapping& mapping, const char* key,
                     std::initializer_list<const char*> words) {
  const std::string word = mapping.Text(key).value_or("");
  if (word.empty() || std::find(words.begin(), words.end(), word) != words.end()) return word;
  std::string list;
  for (const char* each : words) list += (list.empty() ? "" : ", ") + std::string(each);
  mapping.AddProblem(key,
                     std::string(key) + " must be one of " + list + ", found \"" + word + "\"");
  return {};
}

// Reads the key `ros2`: true, false, or a mapping of settings.
std::optional<Ros2Settings> ReadRos2(YamlMapping& mapping) {
  const auto node = mapping.Any("ros2");
  if (!node) return std::nullopt;
  const std::string word = node->IsScalar() ? node->Scalar() : "";
  if (word == "false") return std::nullopt;
  Ros2Settings settings;
  if (word == "true") return settings;
  YamlMapping keys(*node, mapping.FieldOf("ros2"), mapping.place());
  settings.range = ReadWord(keys, "range", {"localhost", "subnet"});
  settings.cmd_vel = ReadWord(keys, "cmd_vel", {"twist", "twist_stamped"});
  settings.distro = ReadWord(keys, "distro", {"humble", "jazzy", "kilted", "lyrical"});
  const auto namespaces = keys.Any("namespaces");
  if (!namespaces) return settings;
  YamlMapping robots(*namespaces, keys.FieldOf("namespaces"), mapping.place());
  if (!robots.is_mapping()) return settings;
  for (const auto& entry : *namespaces) {
    const std::string robot = entry.first.Scalar();
    const std::string name_space = robots.Text(robot).value_or("");
    if (name_space.starts_with('/')) {
      settings.namespaces[robot] = name_space;
    } else {
      robots.AddProblem(robot,
                        "a namespace must begin with a slash, such as /fleet, or / for none");
    }
  }
  return settings;
}

// Reads the target real-time factor. The key `factor` is its deprecated name.
std::optional<double> ReadRealTimeFactor(YamlMapping& mapping) {
  const auto factor =
      mapping.Number("real_time_factor", kMinRealTimeFactor, model::kMaxRealTimeFactor);
  const auto former = mapping.Number("factor", kMinRealTimeFactor, model::kMaxRealTimeFactor);
  if (mapping.Has("factor") && mapping.Has("real_time_factor")) {
    mapping.AddProblem("factor", "is the former name of real_time_factor; give one of the two");
  }
  return factor ? factor : former;
}

// Reads the step. 0 means the step of the world (default: 0).
std::optional<double> ReadStep(YamlMapping& mapping) {
  const auto step = mapping.Number("step", 0, 10);
  if (step == 0.0) return std::nullopt;
  if (step && *step < kMinStep) {
    mapping.AddProblem("step", "a step is at least 1 microsecond, or 0 for the world's step");
    return std::nullopt;
  }
  return step;
}

// Reads the name of the recording. Refuses true and false, which are values of `record` in requests
// to a server. The server removes them from the request before it reads the scenario.
std::string ReadRecord(YamlMapping& mapping) {
  const std::string record = mapping.Text("record").value_or("");
  if (record == "true" || record == "false") {
    mapping.AddProblem("record",
                       "record must be a file, NAME.mcap, or a folder, found \"" + record + "\"");
    return {};
  }
  return record;
}

}  // namespace

std::optional<Place> ReadPlaceKeys(YamlMapping& mapping) {
  const auto x = mapping.Number("x", -kMaxCoordinate, kMaxCoordinate);
  const auto y = mapping.Number("y", -kMaxCoordinate, kMaxCoordinate);
  const auto z = mapping.Number("z", -kMaxCoordinate, kMaxCoordinate);
  const auto yaw = mapping.Angle("yaw");
  if (x && y) return Place{*x, *y, z, yaw.value_or(0)};
  const bool has_any = mapping.Has("x") || mapping.Has("y") || z || yaw;
  if (has_any && !(mapping.Has("x") && mapping.Has("y"))) {
    mapping.AddProblem(mapping.Has("x") ? "y" : "x", "a place needs both x and y");
  }
  return std::nullopt;
}

RobotEntry ReadRobotKeys(YamlMapping& mapping, bool is_avatar) {
  RobotEntry robot;
  robot.name = mapping.Text("name").value_or("");
  robot.model = mapping.Text("model").value_or("");
  robot.start = ReadPlaceKeys(mapping);
  if (!is_avatar) {
    robot.behaviour = mapping.Text("behaviour").value_or("");
    robot.behaviour_constraint = mapping.Text("behaviour_constraint").value_or("");
    robot.movement = ReadMovement(mapping);
    robot.drive = ReadDrive(mapping);
  }
  CheckRobot(robot, is_avatar, mapping);
  return robot;
}

Scenario ReadScenarioKeys(const YAML::Node& node, const YamlPlace& place) {
  YamlMapping mapping(node, "", place);
  Scenario scenario;
  scenario.world = mapping.Text("world").value_or("");
  scenario.name = mapping.Text("name").value_or("");
  scenario.seed = mapping.Count("seed");
  scenario.lockstep = mapping.IsSecondOf("mode", "real_time", "lockstep");
  scenario.factor = ReadRealTimeFactor(mapping);
  scenario.step = ReadStep(mapping);
  scenario.duration = mapping.Number("duration", 0, kMaxDuration);
  scenario.deadline = mapping.Number("deadline", 0, kMaxDuration);
  scenario.stuck_after = mapping.Number("stuck_after", 0.1, kMaxDuration);
  scenario.fails_with_behaviour = mapping.IsSecondOf("on_failure", "go_on", "fail");
  scenario.in_process = mapping.Flag("in_process");
  scenario.model_path = mapping.Texts("model_path");
  scenario.robots = ReadRobots(mapping, "robots");
  scenario.avatars = ReadRobots(mapping, "avatars");
  scenario.pedestrians = ReadPedestrianGroups(mapping);
  scenario.record = ReadRecord(mapping);
  scenario.record_topics = mapping.Texts("record_topics");
  scenario.record_rates = ReadRates(mapping);
  scenario.record_png = mapping.IsSecondOf("record_pictures", "jpeg", "png");
  scenario.ros2 = ReadRos2(mapping);
  scenario.faults = ReadFaults(mapping);
  scenario.expect = ReadExpectations(mapping, scenario.duration.value_or(0));
  return scenario;
}

}  // namespace gsv::scenario
