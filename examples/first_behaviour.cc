// A first behaviour: drives forward and turns in front of walls.
//
//   gsv run --robot pebble --behaviour first
#include "sdk/behaviour/module.h"
#include "sdk/behaviour/sonar_ring.h"

namespace {

class First final : public gsv::Behaviour {
 public:
  gsv::base::Status Init(gsv::Robot& robot) override {
    auto sonars = gsv::SonarRing::Open(robot, 8);
    if (!sonars) return gsv::base::Fail(sonars.error());
    sonars_ = *std::move(sonars);
    return {};
  }

  void Run(gsv::Robot& robot) override {
    using namespace std::chrono_literals;
    do {
      const bool blocked = Nearest(sonars_.Read(), 0.0, 0.9) < robot.footprint_radius() + 0.4;
      robot.Drive(blocked ? 0.0 : 0.3, blocked ? 0.8 : 0.0);
    } while (robot.SleepFor(50ms));
  }

 private:
  gsv::SonarRing sonars_;
};

}  // namespace

GSV_BEHAVIOUR("first", "Drives forward and turns in front of walls.", First)
