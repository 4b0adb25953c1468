// Wanders about: goes forward where the eight sonars leave room, else turns to the freer side;
// takes a picture every second.
#include <algorithm>
#include <cmath>
#include <vector>

#include "sdk/behaviour/sonar_ring.h"
#include "sdk/serve.h"

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
      const std::vector<SonarRing::Echo> echoes = sonars_.Read();
      const DriveCommand command =
          IsStuck(echoes) ? BackOut() : Decide(robot.footprint_radius(), echoes);
      robot.Drive(command.linear, command.angular);
      going_ = command.linear > 0;
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
    // Drifts to one side and then to the other: straight lines see little of a room.
    drift_ = (drift_ + 1) % 400;
    const double speed = std::clamp(0.5 * (ahead - radius), 0.1, 0.4);
    return {speed, drift_ < 200 ? 0.1 : -0.1};
  }

  // Something between the beams holds the robot: it should go forward, and what it sees does not
  // change for a second.
  bool IsStuck(const std::vector<SonarRing::Echo>& echoes) {
    if (backing_ > 0) return true;
    double change = 0;
    bool sees_anything = false;
    for (std::size_t i = 0; i < echoes.size() && i < before_.size(); ++i) {
      change += std::abs(echoes[i].distance - before_[i].distance);
      sees_anything = sees_anything || echoes[i].in_reach;
    }
    still_ = going_ && sees_anything && change < 0.01 ? still_ + 1 : 0;
    before_ = echoes;
    if (still_ < 20) return false;
    still_ = 0;
    backing_ = 40;
    return true;
  }

  DriveCommand BackOut() {
    --backing_;
    return backing_ > 20 ? DriveCommand{-0.2, 0.0} : DriveCommand{0.0, 0.9};
  }

  SonarRing sonars_;
  std::vector<SonarRing::Echo> before_;  // of the last cycle
  bool going_ = false;
  int still_ = 0;    // control cycles without a change
  int backing_ = 0;  // control cycles of backing out that are left
  std::unique_ptr<Camera> camera_;
  int turn_ = 0;   // +1: to the left, -1: to the right, 0: going forward
  int drift_ = 0;  // control cycles
};

}  // namespace

int main(int argc, char** argv) {
  return gsv::ServeBehaviour(argc, argv, {"wander", "Wanders about without hitting anything."},
                             [] { return std::make_unique<Wander>(); });
}
