// Drives to a point in the world, around obstacles, and finishes there.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <CLI/CLI.hpp>

#include "sdk/behaviour/module.h"
#include "sdk/behaviour/sonar_ring.h"

namespace {

using namespace gsv;

struct Goal {
  double x = 0, y = 0;      // m, world
  double tolerance = 0.15;  // m
};

class GoTo final : public Behaviour {
 public:
  explicit GoTo(Goal goal) : goal_(goal) {}

  base::Status Init(Robot& robot) override {
    auto sonars = SonarRing::Open(robot, 16);
    if (!sonars) return base::Fail(sonars.error());
    sonars_ = *std::move(sonars);
    auto positioning = robot.CreatePositioningSystem("goto_position");
    if (!positioning) return base::Fail(positioning.error());
    positioning_ = *std::move(positioning);
    return {};
  }

  void Run(Robot& robot) override {
    for (;;) {
      const Placement here = positioning_->Locate();
      const double dx = goal_.x - here.x, dy = goal_.y - here.y;
      const double distance = std::hypot(dx, dy);
      if (!robot.IsRunning() || distance < goal_.tolerance) break;
      const double bearing = std::remainder(std::atan2(dy, dx) - here.yaw, 2 * std::numbers::pi);
      const DriveCommand command =
          Decide(robot.footprint_radius(), distance, bearing, sonars_.Read());
      robot.Drive(command.linear, command.angular);
      if (!robot.SleepFor(50ms)) return;
    }
    robot.Drive(0, 0);
  }

 private:
  // Chooses a command by the vector field histogram in its simplest form. The best free direction
  // is near to the direction of the goal, and near to the direction that was chosen last.
  DriveCommand Decide(double radius, double distance, double bearing,
                      const std::vector<SonarRing::Echo>& echoes) {
    const double room = std::min(radius + 0.5, distance + radius);
    double best = 0, best_cost = 1e9;
    for (int i = -16; i < 16; ++i) {
      const double direction = i * std::numbers::pi / 16;
      if (Nearest(echoes, direction, 0.5) < room) continue;
      const double cost = std::abs(std::remainder(direction - bearing, 2 * std::numbers::pi)) +
                          0.4 * std::abs(std::remainder(direction - last_, 2 * std::numbers::pi));
      if (cost < best_cost) best = direction, best_cost = cost;
    }
    // no direction is free, so the robot turns to find one
    if (best_cost > 1e8) return {0.0, 0.6};
    last_ = best;
    if (std::abs(best) < 0.1 && std::abs(bearing) < 0.2) best = bearing;
    const double ahead = Nearest(echoes, 0.0, 0.5);
    const bool facing = std::abs(best) < 0.5 && ahead > radius + 0.1;
    const double speed =
        facing ? std::clamp(0.6 * std::min(distance, ahead - radius), 0.05, 0.35) : 0.0;
    return {speed, std::clamp(1.8 * best, -0.9, 0.9)};
  }

  const Goal goal_;
  SonarRing sonars_;
  std::unique_ptr<PositioningSystem> positioning_;
  double last_ = 0;  // rad: the direction that was chosen last
};

BehaviourFactory Configure(CLI::App& app) {
  const auto goal = std::make_shared<Goal>();
  app.add_option("--goal-x", goal->x, "x of the goal in the world, m")->capture_default_str();
  app.add_option("--goal-y", goal->y, "y of the goal in the world, m")->capture_default_str();
  app.add_option("--tolerance", goal->tolerance,
                 "distance from the goal at which the robot stops, m")
      ->capture_default_str();
  return [goal] { return std::make_unique<GoTo>(*goal); };
}

}  // namespace

GSV_BEHAVIOUR_MODULE((gsv::BehaviourModule{gsv::kBehaviourInterface, "goto",
                                           "Drives to a point, around obstacles.", Configure}))
