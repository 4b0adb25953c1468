#include "gsv/simulation/editing/robot_models.h"

#include "gsv/model/drive_choice.h"

namespace gsv::simulation {

base::Result<std::shared_ptr<const model::Model>> RobotModels::Find(
    const std::shared_ptr<const model::Model>& model, const std::string& drive, bool is_avatar) {
  if (drive.empty() && model->drive) return model;
  const std::string choice = drive.empty() && is_avatar ? "omni" : drive;
  Entry& entry = robots_[{model.get(), choice}];
  if (entry.robot == nullptr) {
    auto robot = model::AsRobot(model, choice);
    if (!robot) {
      robots_.erase({model.get(), choice});
      return robot;
    }
    entry = {model, *std::move(robot)};
  }
  return entry.robot;
}

}  // namespace gsv::simulation
