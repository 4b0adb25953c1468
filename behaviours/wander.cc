// Wanders about: goes forward where the eight sonars leave room, else turns to the freer side;
// takes a picture every second.
#include <algorithm>
#include <numbers>
#include <vector>

#include "sdk/behaviour/module.h"
#include "sdk/behaviour/sonar_ring.h"

namespace {

using namespace gsv;

class Wander final : public Behaviour {
 public:
  base::Status Init(Robot& robot) override {
    auto sonars = SonarRing::Open(robot, 8);
    if (!sonars) return base::Fail(sonars.error());
    sonars_ = *std::move(sonars);
    auto camera = OpenOrMountCamera(robot);
    if (camera) camera_ = *std::move(camera);  // a robot that cannot have one wanders without
    return {};
  }

  void Run(Robot& robot) override {
    SimTime next_picture = robot.Now();
    do {
      const DriveCommand command = Decide(robot.footprint_radius(), sonars_.Read());
      robot.Drive(command.linear, command.angular);
      if (camera_ != nullptr && robot.Now() >= next_picture) {
        camera_->TakePicture();
        next_picture += 1s;
        if (!robot.SleepFor(20ms)) return;
      }
    } while (robot.SleepFor(50ms));
  }

 private:
  static base::Result<std::unique_ptr<Camera>> OpenOrMountCamera(Robot& robot) {
    for (const SensorTraits& sensor : robot.Sensors()) {
      if (sensor.type == "camera") return robot.OpenCamera(sensor.name);
    }
    return robot.CreateCamera("camera", {.x = 0.05, .z = 0.25}, 320, 240, 1.047);
  }

  DriveCommand Decide(double radius, const std::vector<SonarRing::Echo>& echoes) {
    if (reconsidering_ > 0) return Reconsider(radius, echoes);
    const double ahead = Nearest(echoes, 0.0, 0.9);
    const double left = Nearest(echoes, 0.9, 0.9);
    const double right = Nearest(echoes, -0.9, 0.9);
    // Starts to turn a good length before an obstacle, and turns until there is more room.
    const double enough = radius + (turn_ != 0 ? 0.7 : 0.4);
    if (ahead < enough) {
      if (turn_ == 0) turn_ = left >= right ? 1 : -1;
      return {0.0, 0.9 * turn_};
    }
    turn_ = 0;
    // Drifts to one side and then to the other: straight lines see little of a room. After a while
    // it tries another way: something between the beams may hold it.
    forward_ = (forward_ + 1) % kReconsiderAfter;
    if (forward_ == 0) reconsidering_ = kReconsiderFor;
    const double speed = std::clamp(0.5 * (ahead - radius), 0.1, 0.4);
    return {speed, forward_ < kReconsiderAfter / 2 ? 0.1 : -0.1};
  }

  // Backs out where there is room behind, then turns.
  DriveCommand Reconsider(double radius, const std::vector<SonarRing::Echo>& echoes) {
    --reconsidering_;
    const bool room_behind = Nearest(echoes, std::numbers::pi, 0.9) > radius + 0.25;
    if (reconsidering_ > kReconsiderFor / 2 && room_behind) return {-0.2, 0.0};
    return {0.0, 0.9};
  }

  // In control cycles.
  static constexpr int kReconsiderAfter = 200;
  static constexpr int kReconsiderFor = 40;

  SonarRing sonars_;
  std::unique_ptr<Camera> camera_;
  int turn_ = 0;           // +1: to the left, -1: to the right, 0: going forward
  int forward_ = 0;        // control cycles spent going forward
  int reconsidering_ = 0;  // control cycles of it that are left
};

}  // namespace

GSV_BEHAVIOUR("wander", "Wanders about without hitting anything.", Wander)
