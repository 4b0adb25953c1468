#include "sdk/behaviour_servant.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/orb/orb.h"
#include "gsv/services/hardware_servants.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::sdk {
namespace {

using ::testing::HasSubstr;

// A behaviour without its sensor. It must never run.
class Unready final : public Behaviour {
 public:
  base::Status Init(Robot& robot) override {
    if (auto opened = robot.Open<Sonar>("absent"); !opened) return base::Fail(opened.error());
    return {};
  }
  void Run(Robot&) override { ADD_FAILURE() << "runs although Init() failed"; }
};

TEST(BehaviourServant, CannotStartAfterAnErrorOfInit) {
  const auto simulation = simulation::Make(simulation::Lockstep(base::SimTime(100'000'000)));
  ASSERT_TRUE(simulation->AddRobot(simulation::Robot("robot", 0, 0, nullptr)));
  const auto orb = orb::StartOrb({});
  ASSERT_TRUE(orb) << orb.error().Sentence();
  {
    const PortableServer::POA_var poa = orb::RootPoa(*orb);
    const auto group = std::make_shared<services::ServantGroup>(poa);
    const sba::Hardware_var hardware =
        services::ActivateHardware(simulation->agent("robot"), group);
    const PortableServer::Servant_var<BehaviourServant> servant(
        new BehaviourServant(poa, [] { return std::make_unique<Unready>(); }));
    for (int i = 0; i < 2; ++i) {  // the second init() follows a failed one
      try {
        servant->init("robot", hardware);
        FAIL() << "init() did not throw";
      } catch (const sba::Failed& failed) {
        EXPECT_THAT(failed.reason.in(), HasSubstr("absent"));
      } catch (const sba::Refused& refused) {
        EXPECT_THAT(refused.reason.in(), HasSubstr("absent"));
      }
      EXPECT_THROW(servant->start(), sba::Refused);
    }
    group->DeactivateAll();
  }
  (*orb)->destroy();
}

}  // namespace
}  // namespace gsv::sdk
