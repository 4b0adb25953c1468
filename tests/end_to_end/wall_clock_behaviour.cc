// For tests: a behaviour that does not use simulated clocks. It sleeps by the wall clock and never
// waits for the robot's clock.
#include <chrono>
#include <thread>

#include <CLI/CLI.hpp>

#include "sdk/behaviour/sonar_ring.h"
#include "sdk/serve.h"

namespace {

using namespace gsv;

class OldStyle final : public Behaviour {
 public:
  base::Status Init(Robot& robot) override {
    auto sonars = SonarRing::Open(robot, 8);
    if (!sonars) return base::Fail(sonars.error());
    sonars_ = *std::move(sonars);
    return {};
  }
  void Run(Robot& robot) override {
    while (robot.IsRunning()) {
      const bool blocked = Nearest(sonars_.Read(), 0.0, 0.9) < robot.footprint_radius() + 0.4;
      robot.Drive(blocked ? 0.0 : 0.4, blocked ? 0.8 : 0.0);
      std::this_thread::sleep_for(20ms);
    }
  }

 private:
  SonarRing sonars_;
};

BehaviourFactory Configure(CLI::App&) {
  return [] { return std::make_unique<OldStyle>(); };
}

}  // namespace

int main(int argc, char** argv) {
  return gsv::ServeBehaviour(argc, argv,
                             {.name = "old-style",
                              .description = "Sleeps by the wall clock.",
                              .configure = Configure,
                              .time_managed = false});
}
