// Tests a robot's joint that is commanded over CORBA and in process.
#include <gmock/gmock.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

constexpr char kWorld[] =
    "<sdf version='1.9'><world name='w'><include><uri>model://ground_plane</uri></include>"
    "</world></sdf>";
constexpr char kLift[] =
    "<sdf version='1.9'><model name='lift'><link name='base'><pose>0 0 0.15 0 0 0</pose><inertial>"
    "<mass>20</mass></inertial><collision name='c'><geometry><box><size>0.5 0.5 0.3</size></box>"
    "</geometry></collision></link><link name='fork'><pose>0 0 0.4 0 0 0</pose><inertial><mass>2"
    "</mass></inertial><collision name='c'><geometry><box><size>0.4 0.4 "
    "0.05</size></box></geometry>"
    "</collision></link><joint name='lift' "
    "type='prismatic'><parent>base</parent><child>fork</child>"
    "<axis><xyz>0 0 1</xyz><limit><lower>0</lower><upper>0.5</upper><effort>100</effort></limit>"
    "</axis></joint><plugin filename='gz-sim-velocity-control-system' name='v'/></model></sdf>";

class Joints : public ::testing::Test {
 protected:
  static std::filesystem::path Plugins() { return Program("../tests"); }

  Outcome Run(const std::string& robot, const std::string& name,
              const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"run",         folder_.Write("w.sdf", kWorld).string(),
                                          "--robot",     robot,
                                          "--movement",  name + "=rigid",
                                          "--behaviour", "lifting",
                                          "--lockstep",  "--duration",
                                          "3",           "--headless",
                                          "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Running("gsv", arguments, {"env", "GSV_PLUGIN_PATH=" + Plugins().string()}).AwaitEnd();
  }
  std::string Lift() const { return folder_.Write("lift.sdf", kLift).string(); }

  base::testing::TestFolder folder_;
};

TEST_F(Joints, FollowCommandsOverCorbaAndInProcess) {
  const BrokerProcess broker;
  Running lifting((Plugins() / "gsv-lifting").string(), {"--broker", broker.reference()});
  lifting.AwaitLine("offered at");
  const Outcome over_corba = Run(Lift(), "lift", {"--broker", broker.reference()});
  EXPECT_EQ(over_corba.ending, "exit code 0") << over_corba.out << over_corba.err;
  const Outcome in_process = Run(Lift(), "lift", {"--in-process"});
  EXPECT_EQ(in_process.ending, "exit code 0") << in_process.out << in_process.err;
  EXPECT_EQ(over_corba.LastLine()["state_hash"], in_process.LastLine()["state_hash"]);
}

// The behaviour requests a joint that this robot does not have.
TEST_F(Joints, UnknownJointsAreRejected) {
  const Outcome outcome = Run("pebble", "pebble", {"--in-process"});
  EXPECT_NE(outcome.ending, "exit code 0");
  EXPECT_THAT(outcome.err, ::testing::HasSubstr("lift"));
}

}  // namespace
}  // namespace gsv::testing
