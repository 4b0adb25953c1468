// Runs robots with lamps and speakers. Each is driven by its own program or inside gsv.
#include "tests/end_to_end/four_robots.h"

namespace gsv::testing {
namespace {

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

class ActuatorsRun : public FourRobots {
 protected:
  ActuatorsRun() : FourRobots(Signaller("90"), "signalling") {}
};

TEST_F(ActuatorsRun, HashIsEqualOverCorbaAndInProcessWithAnyNumberOfThreads) {
  ExpectTheSameOverCorbaAndInProcess();
}

TEST_F(ActuatorsRun, CheckReportsTheErrorOfASpeaker) {
  const std::string file = folder_.Write("signaller.sdf", Signaller("1000")).string();
  const Outcome check = Running("gsv", {"model", "check", "--strict", file}).AwaitEnd();
  EXPECT_EQ(check.ending, "exit code 3");
  EXPECT_NE(check.out.find("loudness is 1000; it must lie between 0 and 200"), std::string::npos)
      << check.out;
}

TEST_F(ActuatorsRun, ResimulationRepeatsTheCommands) { ExpectTheSameAgainFromItsRecording(); }

}  // namespace
}  // namespace gsv::testing
