// Drives ahead until a body is between its gripper fingers, and carries it to a point in the world.
// Its LED shows the state: yellow before the grasp, green while it carries a body, blue when it has
// finished, red if the fingers have closed without a body.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <CLI/CLI.hpp>

#include "sdk/behaviour/module.h"

namespace {

using namespace gsv;

constexpr Colour kYellow{1, 0.7, 0}, kGreen{0, 1, 0}, kRed{1, 0, 0};
// If the sonar measures less than this (m), a body is between the fingers.
constexpr double kBetweenFingers = 0.03;
constexpr double kBackOff = 0.3;        // distance to drive back after the release, m
constexpr double kBackOffSpeed = 0.15;  // m/s

struct FetchGoal {
  double x = 0, y = 0;      // the place in the world where it releases the body, m
  double tolerance = 0.05;  // m
};

class Fetch final : public Behaviour {
 public:
  explicit Fetch(FetchGoal goal) : goal_(goal) {}

  base::Status Init(Robot& robot) override {
    auto ahead = robot.OpenSonar("ahead");
    if (!ahead) return base::Fail(ahead.error());
    auto gripper = robot.Open<Gripper>("gripper");
    if (!gripper) return base::Fail(gripper.error());
    auto led = robot.Open<Lamp>("led");
    if (!led) return base::Fail(led.error());
    auto speaker = robot.Open<Speaker>("speaker");
    if (!speaker) return base::Fail(speaker.error());
    auto positioning = robot.CreatePositioningSystem("fetch_position");
    if (!positioning) return base::Fail(positioning.error());
    ahead_ = *std::move(ahead), gripper_ = *std::move(gripper), led_ = *std::move(led);
    speaker_ = *std::move(speaker), positioning_ = *std::move(positioning);
    return {};
  }

  void Run(Robot& robot) override {
    (void)led_->Set(kYellow);
    if (!Approach(robot) || !GraspBody(robot)) return;
    if (gripper_->Read().held.empty()) return Say(kRed, 220);
    Say(kGreen, 880);
    if (!CarryToGoal(robot)) return;
    (void)gripper_->Open();
    if (!robot.SleepFor(700ms)) return;
    for (double way = 0; way < kBackOff; way += 0.05 * kBackOffSpeed) {
      robot.Drive(-kBackOffSpeed, 0);
      if (!robot.SleepFor(50ms)) return;
    }
    robot.Drive(0, 0);
    Say({0, 0, 1}, 1320);
  }

 private:
  bool Approach(Robot& robot) {
    for (double range = ahead_->Range(); range > kBetweenFingers; range = ahead_->Range()) {
      robot.Drive(std::clamp(0.8 * (range - kBetweenFingers), 0.02, 0.3), 0);
      if (!robot.SleepFor(50ms)) return false;
    }
    robot.Drive(0, 0);
    return robot.IsRunning();
  }

  // Closes the fingers, and waits until they hold a body or are completely closed.
  bool GraspBody(Robot& robot) {
    (void)gripper_->Grasp();
    for (;;) {
      if (!robot.SleepFor(50ms)) return false;
      const Gripper::State jaws = gripper_->Read();
      if (!jaws.held.empty() || jaws.opening <= 0) return true;
    }
  }

  bool CarryToGoal(Robot& robot) {
    for (;;) {
      const Placement here = positioning_->Locate();
      const double dx = goal_.x - here.x, dy = goal_.y - here.y;
      const double distance = std::hypot(dx, dy);
      if (!robot.IsRunning()) return false;
      if (distance < goal_.tolerance) break;
      const double bearing = std::remainder(std::atan2(dy, dx) - here.yaw, 2 * std::numbers::pi);
      const double speed = std::abs(bearing) < 0.3 ? std::clamp(distance, 0.05, 0.3) : 0;
      robot.Drive(speed, std::clamp(2 * bearing, -1.0, 1.0));
      if (!robot.SleepFor(50ms)) return false;
    }
    robot.Drive(0, 0);
    return robot.SleepFor(500ms);
  }

  void Say(const Colour& colour, double frequency) {
    (void)led_->Set(colour);
    (void)speaker_->Beep(frequency);
  }

  const FetchGoal goal_;
  std::unique_ptr<Sonar> ahead_;
  std::unique_ptr<Gripper> gripper_;
  std::unique_ptr<Lamp> led_;
  std::unique_ptr<Speaker> speaker_;
  std::unique_ptr<PositioningSystem> positioning_;
};

BehaviourFactory Configure(CLI::App& app) {
  const auto goal = std::make_shared<FetchGoal>();
  app.add_option("--goal-x", goal->x, "x of the goal in the world, m")->capture_default_str();
  app.add_option("--goal-y", goal->y, "y of the goal in the world, m")->capture_default_str();
  app.add_option("--tolerance", goal->tolerance,
                 "distance from the goal at which the robot stops, m")
      ->capture_default_str();
  return [goal] { return std::make_unique<Fetch>(*goal); };
}

}  // namespace

GSV_BEHAVIOUR_MODULE((gsv::BehaviourModule{gsv::kBehaviourInterface, "fetch",
                                           "Carries the object in front of its gripper to a point.",
                                           Configure}))
