// Robots with lamps and speakers, each driven by a program of its own or inside gsv.
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

constexpr char kWorld[] =
    "<sdf version='1.9'><world name='w'><include><uri>model://ground_plane</uri></include>"
    "</world></sdf>";
constexpr char kSignaller[] =
    "<sdf version='1.9' xmlns:gsv='https://gsv/'><model name='signaller'><link name='base'>"
    "<pose>0 0 0.15 0 0 0</pose><collision name='c'><geometry><cylinder><radius>0.2</radius>"
    "<length>0.3</length></cylinder></geometry></collision>"
    "<sensor name='lamp' type='led'><gsv:colour>1 0.5 0</gsv:colour><gsv:brightness>0.2"
    "</gsv:brightness></sensor><sensor name='speaker' type='speaker'><gsv:loudness>%s"
    "</gsv:loudness></sensor></link>"
    "<plugin filename='gz-sim-velocity-control-system' name='v'/></model></sdf>";

std::string Signaller(const std::string& loudness) {
  std::string text = kSignaller;
  return text.replace(text.find("%s"), 2, loudness);
}

class ActuatorsRun : public ::testing::Test {
 protected:
  Outcome Run(const std::vector<std::string>& more) const {
    const std::string signaller = folder_.Write("signaller.sdf", Signaller("90")).string();
    std::vector<std::string> arguments = {"run", folder_.Write("w.sdf", kWorld).string()};
    for (const char* place : {"0,0", "1.5,0.5", "3.5,0", "-2,-1"}) {
      arguments.insert(arguments.end(), {"--robot", signaller + "@" + place});
    }
    arguments.insert(arguments.end(), {"--behaviour", "signalling", "--lockstep", "--duration", "2",
                                       "--headless", "--json"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Running("gsv", arguments, {"env", "GSV_PLUGIN_PATH=" + Plugins()}).AwaitEnd();
  }
  static std::string Plugins() { return Program("../tests").string(); }

  TemporaryFolder folder_;
};

TEST_F(ActuatorsRun, GoTheSameOverCorbaAndInProcessWithAnyNumberOfThreads) {
  const BrokerProcess broker;
  Running signalling(Plugins() + "/gsv-signalling", {"--broker", broker.reference()});
  signalling.AwaitLine("offered at");
  const Outcome over_corba = Run({"--broker", broker.reference()});
  ASSERT_EQ(over_corba.ending, "exit code 0") << over_corba.out << over_corba.err;
  for (const char* threads : {"1", "2", "3"}) {
    const Outcome in_process = Run({"--in-process", "--threads", threads});
    ASSERT_EQ(in_process.ending, "exit code 0") << in_process.out << in_process.err;
    EXPECT_EQ(in_process.LastLine()["state_hash"], over_corba.LastLine()["state_hash"]);
  }
}

TEST_F(ActuatorsRun, ACheckSaysWhatIsWrongWithASpeaker) {
  const std::string file = folder_.Write("signaller.sdf", Signaller("1000")).string();
  const Outcome check = Running("gsv", {"model", "check", file}).AwaitEnd();
  EXPECT_EQ(check.ending, "exit code 3");
  EXPECT_NE(check.out.find("loudness is 1000; it must lie between 0 and 200"), std::string::npos)
      << check.out;
}

TEST_F(ActuatorsRun, TellsThemTheSameAgainFromItsRecording) {
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
