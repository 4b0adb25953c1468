// Wanders like the behaviour `wander`, but takes no images. One round trip per control cycle
// transfers the readings of the sonars and the command.
#include "behaviours/wander_rule.h"
#include "sdk/behaviour/module.h"

namespace {

using namespace gsv;

class Cruise final : public Controller {
 public:
  Cruise() : Controller(50ms) {}

  base::Status Init(Robot& robot) override {
    auto sonars = SonarRing::Open(robot, 8);
    if (!sonars) return base::Fail(sonars.error());
    sonars_ = *std::move(sonars);
    radius_ = robot.footprint_radius();
    return {};
  }

  DriveCommand Control(const std::vector<Reading>& readings) override {
    return rule_.Decide(radius_, sonars_.From(readings));
  }

 private:
  SonarRing sonars_;
  double radius_ = 0;  // m
  WanderRule rule_;
};

}  // namespace

GSV_BEHAVIOUR("cruise", "Wanders about, with one round trip per control cycle.", Cruise)
