// Makes robots, with their drives, from models. Robots of the same model and drive choice share one
// resulting model.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "gsv/base/error.h"
#include "gsv/model/model.h"

namespace gsv::simulation {

// Makes the models of robots, with their drives, and shares equal models.
class RobotModels {
 public:
  // Calls model::AsRobot(). An avatar without a drive accepts any velocity.
  base::Result<std::shared_ptr<const model::Model>> Find(
      const std::shared_ptr<const model::Model>& model, const std::string& drive, bool is_avatar);

 private:
  // A model, and the robot that was made from it.
  struct Entry {
    std::shared_ptr<const model::Model> model, robot;
  };
  // Results by the model's address and the drive choice. An entry keeps its model alive. The map is
  // never iterated.
  std::map<std::pair<const model::Model*, std::string>, Entry> robots_;
};

}  // namespace gsv::simulation
