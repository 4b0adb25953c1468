// For tests: a behaviour that commands and reads a joint. The lift moves to 0.3 m, and the
// behaviour fails if it does not arrive.
#include <cmath>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "sdk/behaviour/module.h"

namespace {

using namespace gsv;

class Lifting final : public Behaviour {
 public:
  base::Status Init(Robot& robot) override {
    for (const JointTraits& traits : robot.Joints()) {
      if (traits.max_effort != 100) throw std::runtime_error("the limits are not the model's");
    }
    auto joint = robot.OpenJoint("lift");
    if (!joint) return base::Fail(joint.error());
    joint_ = *std::move(joint);
    return {};
  }
  void Run(Robot& robot) override {
    joint_->MoveTo(0.3);
    if (!robot.SleepFor(2s)) return;
    const double reached = joint_->Read().position;
    if (std::abs(reached - 0.3) > 1e-3) {
      throw std::runtime_error("the lift is at " + std::to_string(reached));
    }
    joint_->MoveAt(-0.1);
    while (robot.SleepFor(100ms)) {
    }
  }

 private:
  std::unique_ptr<Joint> joint_;
};

}  // namespace

GSV_BEHAVIOUR("lifting", "Lifts.", Lifting)
