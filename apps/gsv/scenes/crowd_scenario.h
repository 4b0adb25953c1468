// The scene of `gsv bench crowd`. The speed of other simulators was measured in the same scene.
// Robots wander on a walled square with 10 m² per robot. For every four robots there is a box of
// 1 m.
#pragma once

#include <memory>

#include "gsv/simulation/simulation.h"
#include "sdk/behaviour/behaviour.h"

namespace gsv::app {

inline constexpr double kCrowdRobotRadius = 0.175;  // radius of a robot, which is a disc, m
inline constexpr double kCrowdRange = 5;            // maximum range of a robot's rays, m
inline constexpr double kCrowdRayHeight = 0.15;     // height of the rays above the ground, m
inline constexpr int kCrowdRays = 8;                // number of rays of each robot

// Returns the world with walls, boxes and ground.
std::shared_ptr<const model::WorldDescription> CrowdWorld(int robots, std::uint64_t seed);
// Returns the robots of the crowd, without behaviours.
std::vector<simulation::RobotSpecification> CrowdRobots(int robots, std::uint64_t seed);

// The behaviour of the crowd's robots. It reads the robot's eight rays every 50 ms. It drives
// forward if there is space, else it turns to the side with more space.
class CrowdController : public Controller {
 public:
  CrowdController() : Controller(std::chrono::milliseconds(50)) {}
  base::Status Init(Robot& robot) override;
  DriveCommand Control(const std::vector<Reading>& readings) override;

 private:
  int turn_ = 0;  // +1 for a turn to the left, -1 to the right, 0 for driving forward
};

}  // namespace gsv::app
