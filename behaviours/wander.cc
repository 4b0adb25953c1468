// Wanders: drives forward if its eight sonars detect space, else turns to the side with more space.
// Takes an image every second.
#include <memory>

#include <CLI/CLI.hpp>

#include "behaviours/wander_rule.h"
#include "sdk/behaviour/module.h"

namespace {

using namespace gsv;

class Wander final : public Behaviour {
 public:
  explicit Wander(bool takes_images) : takes_images_(takes_images) {}

  base::Status Init(Robot& robot) override {
    auto sonars = SonarRing::Open(robot, 8);
    if (!sonars) return base::Fail(sonars.error());
    sonars_ = *std::move(sonars);
    if (!takes_images_) return {};
    auto camera = OpenOrMountCamera(robot);
    if (camera) camera_ = *std::move(camera);  // the camera is optional
    return {};
  }

  void Run(Robot& robot) override {
    SimTime next_image = robot.Now();
    do {
      const DriveCommand command = rule_.Decide(robot.footprint_radius(), sonars_.Read());
      robot.Drive(command.linear, command.angular);
      if (camera_ != nullptr && robot.Now() >= next_image) {
        camera_->TakeImage();
        next_image += 1s;
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

  const bool takes_images_;
  SonarRing sonars_;
  std::unique_ptr<Camera> camera_;
  WanderRule rule_;
};

BehaviourFactory Configure(CLI::App& app) {
  const auto blind = std::make_shared<bool>(false);
  app.add_flag("--no-pictures", *blind, "do not use the camera");
  return [blind] { return std::make_unique<Wander>(!*blind); };
}

}  // namespace

GSV_BEHAVIOUR_MODULE((gsv::BehaviourModule{gsv::kBehaviourInterface, "wander",
                                           "Wanders about without hitting anything.", Configure}))
