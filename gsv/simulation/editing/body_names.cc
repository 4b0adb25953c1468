#include "gsv/simulation/editing/body_names.h"

#include <map>
#include <set>

namespace gsv::simulation {

base::Status CheckBodyName(const std::string& name) {
  if (name.size() <= 128 && name.find('/') == std::string::npos) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "a name has 1 to 128 characters and no \"/\"", name);
}

std::string FreeName(const world::Layout& layout, const std::string& model) {
  std::string name = model;
  for (int number = 2; layout.Find(name) >= 0; ++number) {
    name = model + "_" + std::to_string(number);
  }
  return name;
}

base::Status NameRobots(const world::Layout& layout, std::vector<RobotSpecification>& robots) {
  std::set<std::string> taken;
  for (const world::Body& body : layout.bodies) taken.insert(body.name);
  for (const RobotSpecification& robot : robots) {
    if (robot.name.empty()) continue;
    if (auto ok = CheckBodyName(robot.name); !ok) return ok;
    if (!taken.insert(robot.name).second) {
      return base::Fail(base::ErrorCode::kInvalidArgument, "there is already a body of this name",
                        robot.name);
    }
  }
  // next number to try for each model, so that the search for a free number stays short
  std::map<std::string, int> next_number;
  for (RobotSpecification& robot : robots) {
    if (!robot.name.empty()) continue;
    const std::string& model = robot.model->name;
    int& number = next_number.try_emplace(model, 2).first->second;
    robot.name = model;
    while (!taken.insert(robot.name).second) robot.name = model + "_" + std::to_string(number++);
  }
  return {};
}

}  // namespace gsv::simulation
