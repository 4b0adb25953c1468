// Evenly spaced sonars around a robot: the sonars of its model, or created sonars if the model has
// none.
//
// Frame  bearings are counter-clockwise from straight ahead, in (-pi, pi].
#pragma once

#include <memory>
#include <vector>

#include "sdk/behaviour/robot.h"

namespace gsv {

class SonarRing {
 public:
  // Opens `count` sonars: for each i from 0 to count - 1, the sonar whose bearing is nearest to
  // i * 2 pi / count.
  static base::Result<SonarRing> Open(Robot& robot, int count);

  // The echo of one sonar.
  struct Echo {
    double bearing = 0;    // rad
    double distance = 0;   // distance from the robot's origin, m
    bool in_reach = true;  // false if there is no echo within the sonar's maximum range
  };
  // Reads all sonars, one after the other.
  std::vector<Echo> Read();
  // Returns the ring's echoes in the readings of Robot::Exchange().
  std::vector<Echo> From(const std::vector<Reading>& readings) const;

 private:
  // A sonar of the ring, and where it is mounted.
  struct Mounted {
    std::string name;
    std::unique_ptr<Sonar> sonar;
    double bearing;  // rad
    double offset;   // distance from the robot's origin to the sonar, m
  };
  std::vector<Mounted> sonars_;
};

// Returns the smallest distance of the echoes within `half_angle` of `bearing`, including those out
// of reach; infinite if there are none.
double Nearest(const std::vector<SonarRing::Echo>& echoes, double bearing, double half_angle);

}  // namespace gsv
