// The crowd with which other simulators were measured: robots that wander on a walled square with
// 10 m² per robot and a box of 1 m for every four.
#pragma once

#include <memory>

#include "gsv/simulation/simulation.h"
#include "sdk/behaviour/behaviour.h"

namespace gsv::app {

// A robot of the crowd is a disc.
inline constexpr double kCrowdRobotRadius = 0.175;  // m
inline constexpr double kCrowdRange = 5;            // m: length of its eight rays
inline constexpr double kCrowdRayHeight = 0.15;     // m
inline constexpr int kCrowdRays = 8;

// The world with walls, boxes and ground.
std::shared_ptr<const model::WorldDescription> CrowdWorld(int robots, std::uint64_t seed);
// The robots in it, without behaviours.
std::vector<simulation::RobotSpecification> CrowdRobots(int robots, std::uint64_t seed);

// Reads the eight rays every 50 ms. Drives forward if there is space, else turns to the freer side.
class CrowdController : public Controller {
 public:
  CrowdController() : Controller(std::chrono::milliseconds(50)) {}
  base::Status Init(Robot& robot) override;
  DriveCommand Control(const std::vector<Reading>& readings) override;

 private:
  int turn_ = 0;  // +1: to the left, -1: to the right, 0: going forward
};

}  // namespace gsv::app
