// Evenly spaced sonars around a robot: those of its model, or created ones if it has none.
//
// Frame  bearings are counter-clockwise from straight ahead, in (-pi, pi].
#pragma once

#include <memory>
#include <vector>

#include "sdk/behaviour/robot.h"

namespace gsv {

class SonarRing {
 public:
  // Opens the `count` sonars whose bearings are nearest to 0, 1, … count-1 times 2 pi / count.
  static base::Result<SonarRing> Open(Robot& robot, int count);

  struct Echo {
    double bearing = 0;    // rad
    double distance = 0;   // m from the robot's origin
    bool in_reach = true;  // false: no echo within the sonar's maximum range
  };
  // Reads all sonars, one after the other.
  std::vector<Echo> Read();
  // The echoes of the ring among the readings of Robot::Exchange().
  std::vector<Echo> From(const std::vector<Reading>& readings) const;

 private:
  struct Mounted {
    std::string name;
    std::unique_ptr<Sonar> sonar;
    double bearing;
    double offset;  // m from the robot's origin to the sonar
  };
  std::vector<Mounted> sonars_;
};

// The smallest distance of echoes within `half_angle` of `bearing`; infinite if there is none.
double Nearest(const std::vector<SonarRing::Echo>& echoes, double bearing, double half_angle);

}  // namespace gsv
