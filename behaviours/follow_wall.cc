// Follows the wall on its right at a constant distance. Turns left if the way ahead is blocked.
// Turns right where the wall on the right ends.
#include <algorithm>
#include <numbers>

#include "sdk/behaviour/module.h"
#include "sdk/behaviour/sonar_ring.h"

namespace {

using namespace gsv;

constexpr double kRight = -std::numbers::pi / 2;
constexpr double kHalfSector = 0.45;  // rad

class FollowWall final : public Behaviour {
 public:
  base::Status Init(Robot& robot) override {
    auto sonars = SonarRing::Open(robot, 8);
    if (!sonars) return base::Fail(sonars.error());
    sonars_ = *std::move(sonars);
    return {};
  }

  void Run(Robot& robot) override {
    do {
      const DriveCommand command = Decide(robot.footprint_radius(), sonars_.Read());
      robot.Drive(command.linear, command.angular);
    } while (robot.SleepFor(50ms));
  }

 private:
  static DriveCommand Decide(double radius, const std::vector<SonarRing::Echo>& echoes) {
    const double wanted = radius + 0.4;
    const double ahead = Nearest(echoes, 0.0, kHalfSector);
    const double ahead_right = Nearest(echoes, kRight / 2, kHalfSector);
    const double right = Nearest(echoes, kRight, kHalfSector);
    if (ahead < radius + 0.4 || ahead_right < radius + 0.25) return {0.0, 0.8};
    // The wall on the right has ended, so the robot turns right, around the corner of the wall.
    if (right > 3 * wanted && ahead_right > 3 * wanted) return {0.25, -0.5};
    return {0.25, std::clamp(1.2 * (wanted - std::min(right, ahead_right * 0.8)), -0.6, 0.6)};
  }

  SonarRing sonars_;
};

}  // namespace

GSV_BEHAVIOUR("follow-wall", "Follows the wall on its right.", FollowWall)
