// Robots that talk by radio, each driven by a program of its own or inside gsv.
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

constexpr char kWorld[] =
    "<sdf version='1.9'><world name='w'><include><uri>model://ground_plane</uri></include>"
    "</world></sdf>";
constexpr char kTalker[] =
    "<sdf version='1.9' xmlns:gsv='https://gsv/'><model name='talker'><link name='base'>"
    "<pose>0 0 0.15 0 0 0</pose><collision name='c'><geometry><cylinder><radius>0.2</radius>"
    "<length>0.3</length></cylinder></geometry></collision>"
    "<sensor name='radio' type='radio'><transceiver><essid>test</essid><power>10</power>"
    "</transceiver><gsv:range>3</gsv:range><gsv:inbox>8</gsv:inbox></sensor></link>"
    "<plugin filename='gz-sim-velocity-control-system' name='v'/></model></sdf>";

class RadioRun : public ::testing::Test {
 protected:
  Outcome Run(const std::vector<std::string>& more) const {
    const std::string talker = folder_.Write("talker.sdf", kTalker).string();
    std::vector<std::string> arguments = {"run", folder_.Write("w.sdf", kWorld).string()};
    for (const char* place : {"0,0", "1.5,0.5", "3.5,0", "-2,-1"}) {
      arguments.insert(arguments.end(), {"--robot", talker + "@" + place});
    }
    arguments.insert(arguments.end(), {"--behaviour", "chatting", "--lockstep", "--duration", "2",
                                       "--headless", "--json"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Running("gsv", arguments, {"env", "GSV_PLUGIN_PATH=" + Plugins()}).AwaitEnd();
  }
  static std::string Plugins() { return Program("../tests").string(); }

  TemporaryFolder folder_;
};

TEST_F(RadioRun, GoesTheSameOverCorbaAndInProcessWithAnyNumberOfThreads) {
  const BrokerProcess broker;
  Running chatting(Plugins() + "/gsv-chatting", {"--broker", broker.reference()});
  chatting.AwaitLine("offered at");
  const Outcome over_corba = Run({"--broker", broker.reference()});
  ASSERT_EQ(over_corba.ending, "exit code 0") << over_corba.out << over_corba.err;
  for (const char* threads : {"1", "2", "3"}) {
    const Outcome in_process = Run({"--in-process", "--threads", threads});
    ASSERT_EQ(in_process.ending, "exit code 0") << in_process.out << in_process.err;
    EXPECT_EQ(in_process.LastLine()["state_hash"], over_corba.LastLine()["state_hash"]);
  }
}

TEST_F(RadioRun, SendsTheSameAgainFromItsRecording) {
  const std::string recording = (folder_.path() / "run.mcap").string();
  const Outcome run = Run({"--in-process", "--record", recording});
  ASSERT_EQ(run.ending, "exit code 0") << run.out << run.err;
  const Outcome again =
      RunProgram("gsv", {"replay", recording, "--resimulate", "--commands", "--json"});
  EXPECT_EQ(again.ending, "exit code 0") << again.out << again.err;
  EXPECT_EQ(again.LastLine()["equal"], true) << again.out;
}

}  // namespace
}  // namespace gsv::testing
