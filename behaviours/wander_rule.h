// The rule of a wandering robot: it drives forward if its sonars detect space, else it turns to the
// side with more space.
#pragma once

#include <algorithm>
#include <numbers>
#include <vector>

#include "sdk/behaviour/sonar_ring.h"

namespace gsv {

// Decides how a robot wanders. Call Decide() once per control cycle.
class WanderRule {
 public:
  DriveCommand Decide(double radius, const std::vector<SonarRing::Echo>& echoes) {
    if (reconsidering_ > 0) return Reconsider(radius, echoes);
    const double ahead = Nearest(echoes, 0.0, 0.9);
    const double left = Nearest(echoes, 0.9, 0.9);
    const double right = Nearest(echoes, -0.9, 0.9);
    // The robot starts to turn when an obstacle ahead is nearer than radius + 0.4 m. It turns until
    // no obstacle ahead is nearer than radius + 0.7 m.
    const double enough = radius + (turn_ != 0 ? 0.7 : 0.4);
    if (ahead < enough) {
      if (turn_ == 0) turn_ = left >= right ? 1 : -1;
      return {0.0, 0.9 * turn_};
    }
    turn_ = 0;
    // The robot drifts alternately to the left and to the right, because on a straight path it
    // would see little of a room. After a while it drives backwards and turns (Reconsider()),
    // because it may be blocked by an object that its beams do not hit.
    forward_ = (forward_ + 1) % kReconsiderAfter;
    if (forward_ == 0) reconsidering_ = kReconsiderFor;
    const double speed = std::clamp(0.5 * (ahead - radius), 0.1, 0.4);
    return {speed, forward_ < kReconsiderAfter / 2 ? 0.1 : -0.1};
  }

 private:
  // Drives backwards if there is space behind, then turns.
  DriveCommand Reconsider(double radius, const std::vector<SonarRing::Echo>& echoes) {
    --reconsidering_;
    const bool room_behind = Nearest(echoes, std::numbers::pi, 0.9) > radius + 0.25;
    if (reconsidering_ > kReconsiderFor / 2 && room_behind) return {-0.2, 0.0};
    return {0.0, 0.9};
  }

  // in control cycles
  static constexpr int kReconsiderAfter = 200;
  static constexpr int kReconsiderFor = 40;

  int turn_ = 0;           // +1 for a turn to the left, -1 to the right, 0 for driving forward
  int forward_ = 0;        // number of control cycles spent driving forward
  int reconsidering_ = 0;  // remaining control cycles of Reconsider()
};

}  // namespace gsv
