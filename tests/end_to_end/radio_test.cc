// Runs robots that communicate by radio. Each is driven by its own program or inside gsv.
#include "tests/end_to_end/four_robots.h"

namespace gsv::testing {
namespace {

constexpr char kTalker[] =
    "<sdf version='1.9' xmlns:gsv='https://gsv/'><model name='talker'><link name='base'>"
    "<pose>0 0 0.15 0 0 0</pose><collision name='c'><geometry><cylinder><radius>0.2</radius>"
    "<length>0.3</length></cylinder></geometry></collision>"
    "<sensor name='radio' type='radio'><transceiver><essid>test</essid><power>10</power>"
    "</transceiver><gsv:range>3</gsv:range><gsv:inbox>8</gsv:inbox></sensor></link>"
    "<plugin filename='gz-sim-velocity-control-system' name='v'/></model></sdf>";

class RadioRun : public FourRobots {
 protected:
  RadioRun() : FourRobots(kTalker, "chatting") {}
};

TEST_F(RadioRun, HashIsEqualOverCorbaAndInProcessWithAnyNumberOfThreads) {
  ExpectTheSameOverCorbaAndInProcess();
}

TEST_F(RadioRun, ResimulationRepeatsTheMessages) { ExpectTheSameAgainFromItsRecording(); }

}  // namespace
}  // namespace gsv::testing
