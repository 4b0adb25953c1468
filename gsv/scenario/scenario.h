// What to run: a world, robots and their behaviours. Plain data, and its short forms on the command
// line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/geometry/pose.h"

namespace gsv::scenario {

struct RobotEntry {
  std::string model;                    // a file, folder or name
  std::string name;                     // empty: after its model
  std::optional<geometry::Pose> start;  // planar; without one a free place is looked for
  std::string behaviour;                // empty: none
};

struct Scenario {
  std::string world;  // a file, folder or name
  std::vector<RobotEntry> robots;
};

// Reads "MODEL[@x,y[,yaw]]": metres; yaw in radians, or in degrees when it ends in "deg".
base::Result<RobotEntry> ParseRobot(const std::string& text);

// Our own default world with five robots of four kinds, each with a behaviour.
Scenario DefaultScenario();

}  // namespace gsv::scenario
