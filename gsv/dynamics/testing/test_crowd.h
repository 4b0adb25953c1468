// A crowd for tests and benchmarks: robots that wander about a walled square.
//
// There are 10 m² per robot, and a box of 1 m for every four robots. A robot drives at 0.5 m/s and
// makes a new decision every 0.4 s. A robot in contact drives back and then turns in place. Of the
// robots without contact, one in four drives a curve. So a few per cent of the robots are in
// contact at any time.
#pragma once

#include <cmath>
#include <string>

#include "gsv/base/random.h"
#include "gsv/dynamics/testing/test_world.h"

namespace gsv::dynamics::testing {

class Crowd {
 public:
  static constexpr double kStep = 0.01;  // s

  Crowd(int robots, std::shared_ptr<const model::Model> model, std::unique_ptr<Engine> engine,
        double area_per_robot = 10)
      : world_(std::move(engine)), noise_(1, 2, 3) {
    const double side = std::sqrt(area_per_robot * robots);
    for (int i = 0; i < 4; ++i) {
      const double a = i * 1.5707963267948966, out = side / 2 + 0.6;
      world_.AddBox("wall" + std::to_string(i), {0.2, side + 1.4, 1}, out * std::cos(a),
                    out * std::sin(a), 0, a);
    }
    // Places form a grid, one for each robot and box. Every fifth place has a box.
    const int places = robots + robots / 4;
    const int columns = static_cast<int>(std::ceil(std::sqrt(places)));
    const double raster = side / columns;
    for (int i = 0; i < places; ++i) {
      const int column = i % columns, row = i / columns;
      const double x = (column + 0.5) * raster - side / 2;
      const double y = (row + 0.5) * raster - side / 2;
      const double yaw = Uniform(-3, 3);
      if (i % 5 == 4) {
        world_.AddBox("box" + std::to_string(i), {1, 1, 1}, x, y, 0, yaw);
      } else {
        world_.AddRobot("robot" + std::to_string(i), model, geometry::PlanarPose(x, y, 0, yaw));
      }
    }
  }

  base::Status Start() {
    if (auto ok = world_.Start(); !ok) return ok;
    for (std::size_t i = 0; i < world_.layout().bodies.size(); ++i) {
      if (!world_.layout().bodies[i].is_static()) robots_.push_back(i);
    }
    for (const std::size_t robot : robots_) Drive(world_.state().bodies[robot], {0.5, 0, 0});
    return {};
  }

  // Sends new commands to the robots that are due for a decision.
  void Decide() {
    for (std::size_t i = world_.state().step % kStepsPerChoice; i < robots_.size();
         i += kStepsPerChoice) {
      world::BodyState& body = world_.state().bodies[robots_[i]];
      const double choice = Uniform(0, 1), turn = Uniform(-2, 2);
      const double speed = body.drive.command.linear;
      Drive(body, speed < 0                      ? world::DriveCommand{0, 0, 2 * turn}
                  : speed > 0 && body.in_contact ? world::DriveCommand{-0.3, 0, 0}
                  : choice < 0.25                ? world::DriveCommand{0.5, 0, turn}
                                                 : world::DriveCommand{0.5, 0, 0});
    }
  }

  // Makes the decisions and takes one step. Returns the number of contacts.
  std::size_t Step() {
    Decide();
    world_.Step(base::FromSeconds(kStep), contacts_);
    return contacts_.size();
  }
  // The contacts of the last step.
  const std::vector<world::Contact>& contacts() const { return contacts_; }

  // Returns the fraction of the robots that are in contact.
  double InContact() {
    std::size_t touching = 0;
    for (const std::size_t robot : robots_) touching += world_.state().bodies[robot].in_contact;
    return static_cast<double>(touching) / static_cast<double>(robots_.size());
  }

  TestWorld& world() { return world_; }
  const std::vector<std::size_t>& robots() const { return robots_; }

 private:
  static constexpr int kStepsPerChoice = 40;  // number of steps between two decisions of a robot

  void Drive(world::BodyState& body, const world::DriveCommand& command) {
    body.drive.command = command;
    body.drive.command_time = world_.state().time;
  }
  double Uniform(double low, double high) { return low + (high - low) * noise_.Uniform(); }

  TestWorld world_;
  base::Noise noise_;
  std::vector<std::size_t> robots_;  // indices of the robots' bodies
  std::vector<world::Contact> contacts_;
};

}  // namespace gsv::dynamics::testing
