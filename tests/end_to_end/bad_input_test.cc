// Invalid input, failed programs and missing resources must lead to one clear sentence and the
// right exit code. No command may hang.
#include <csignal>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Strings = std::vector<std::string>;

constexpr const char* kPlayground = "playground";

Outcome Headless(const std::string& world, Strings more) {
  Strings arguments{"run", world, "--headless", "--lockstep", "--json", "--duration", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return RunProgram("gsv", arguments);
}

void ExpectOneSentence(const Outcome& outcome, int exit_code, const std::string& part) {
  EXPECT_EQ(outcome.ending, "exit code " + std::to_string(exit_code)) << outcome.err;
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("gsv: "), HasSubstr(part)));
  EXPECT_THAT(outcome.err, Not(HasSubstr("terminate called")));
}

TEST(BadInput, MissingWorldIsReported) {
  ExpectOneSentence(Headless("/nowhere/world.sdf", {}), 3, "/nowhere/world.sdf");
}

TEST(BadInput, MisspeltWorldGetsASuggestion) {
  const Outcome outcome = Headless("ofice", {});
  ExpectOneSentence(outcome, 3, "ofice: ");
  EXPECT_THAT(outcome.err, HasSubstr("maze, office, playground"));
}

TEST(BadInput, MalformedXmlIsReported) {
  base::testing::TestFolder folder;
  const auto world = folder.Write(
      "bad.sdf", "<?xml version='1.0'?>\n<sdf version='1.9'>\n<world name='w'>\n</sdf>");
  ExpectOneSentence(Headless(world.string(), {}), 3, "bad.sdf:");
}

TEST(BadInput, MissingRobotIsReported) {
  ExpectOneSentence(Headless(kPlayground, {"--robot", "unicorn@0,0"}), 3, "unicorn");
}

std::string RobotWithMesh(const std::string& mesh) {
  return "<sdf version='1.9'><model name='r'><link name='l'><collision "
         "name='c'><geometry><box><size>.3 .3 .3</size></box>"
         "</geometry></collision><visual name='v'><geometry><mesh><uri>" +
         mesh +
         "</uri></mesh></geometry></visual></link>"
         "<plugin filename='gz-sim-velocity-control-system' "
         "name='gz::sim::systems::VelocityControl'/></model></sdf>";
}

TEST(BadInput, MissingMeshIsAWarningAndTheRestRuns) {
  base::testing::TestFolder folder;
  const auto robot = folder.Write("r.sdf", RobotWithMesh("absent.dae"));
  const Outcome outcome = Headless(kPlayground, {"--robot", robot.string() + "@0,0"});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  ASSERT_EQ(outcome.LastLine()["warnings"].size(), 1u) << outcome.out;
  EXPECT_THAT(outcome.LastLine()["warnings"][0].get<std::string>(), HasSubstr("absent.dae"));
}

TEST(BadInput, CorruptMeshIsAWarningAndTheRestRuns) {
  base::testing::TestFolder folder;
  folder.Write("broken.stl", "solid x facet normal 0 0 nonsense");
  const auto robot = folder.Write("r.sdf", RobotWithMesh("broken.stl"));
  const Outcome outcome = Headless(kPlayground, {"--robot", robot.string() + "@0,0"});
  EXPECT_THAT(outcome.err, HasSubstr("broken.stl"));
  EXPECT_THAT(outcome.ending, ::testing::AnyOf("exit code 0", "exit code 3"));
}

TEST(BadInput, MeshWithABillionDeclaredTrianglesIsRejected) {
  base::testing::TestFolder folder;
  std::string stl(84, '\0');
  // The number of triangles: 1,000,000,000.
  stl[80] = '\0', stl[81] = '\xca', stl[82] = '\x9a', stl[83] = '\x3b';
  folder.Write("huge.stl", stl);
  const auto robot = folder.Write("r.sdf", RobotWithMesh("huge.stl"));
  const Outcome outcome = Headless(kPlayground, {"--robot", robot.string() + "@0,0"});
  EXPECT_THAT(outcome.err, HasSubstr("huge.stl"));
  EXPECT_THAT(outcome.ending, ::testing::AnyOf("exit code 0", "exit code 3"));
}

std::string RobotWithSensor(const std::string& sensor) {
  return "<sdf version='1.9' xmlns:gsv='https://gsv.example'>\n<model name='r'><link name='l'>\n" +
         sensor +
         "</link><plugin filename='gz-sim-velocity-control-system' "
         "name='gz::sim::systems::VelocityControl'/></model></sdf>";
}

TEST(BadInput, SensorWithInvalidParametersIsAWarningWithItsLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"<sensor name='eye' type='camera'><camera><image><width>0</width></image></camera></sensor>",
       "image.width is 0"},
      {"<sensor name='eye' type='wideanglecamera'><camera><lens><type>fish</type></lens></camera>"
       "</sensor>",
       "fish"},
      {"<sensor name='eye' type='camera'><camera><distortion><k1>nan</k1></distortion></camera>"
       "</sensor>",
       "distortion.k1 is nan"},
      {"<sensor name='eye' type='imu'><update_rate>10</update_rate><gsv:latency>99</gsv:latency>"
       "</sensor>",
       "latency"},
      {"<sensor name='eye' type='lidar'><lidar><range><min>5</min><max>2</max></range></lidar>"
       "</sensor>",
       "range"}};
  base::testing::TestFolder folder;
  for (const auto& [sensor, part] : cases) {
    const auto robot = folder.Write("r.sdf", RobotWithSensor(sensor));
    const Outcome checked = RunProgram("gsv", {"model", "check", robot.string(), "--json"});
    EXPECT_EQ(checked.ending, "exit code 0") << checked.out;
    const auto line = checked.LastLine();
    EXPECT_EQ(line["severity"], "warning") << sensor;
    EXPECT_THAT(line["where"].get<std::string>(), HasSubstr("r.sdf:3"));
    EXPECT_THAT(line["message"].get<std::string>(), AllOf(HasSubstr("eye"), HasSubstr(part)));
    ExpectOneSentence(Headless(kPlayground, {"--robot", robot.string() + "@0,0", "--strict"}), 3,
                      part);
  }
  const Outcome outcome =
      Headless(kPlayground, {"--robot", (folder.path() / "r.sdf").string() + "@0,0"});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("gsv: warning: "));
}

TEST(BadInput, RepairableModelRunsUnlessStrict) {
  base::testing::TestFolder folder;
  const auto world = folder.Write(
      "w.sdf",
      "<sdf version='1.9'><world name='w'><model name='box'><link name='l'><inertial><mass>-1"
      "</mass></inertial></link></model></world></sdf>");
  const Outcome outcome = Headless(world.string(), {});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("the mass must be above zero; 1 kg is used"));
  ExpectOneSentence(Headless(world.string(), {"--strict"}), 3,
                    "the run is refused because of --strict");
}

TEST(BadInput, SensorOfUnknownTypeIsAWarning) {
  base::testing::TestFolder folder;
  const auto robot =
      folder.Write("r.sdf", RobotWithSensor("<sensor name='nose' type='gas'></sensor>"));
  const Outcome checked = RunProgram("gsv", {"model", "check", robot.string(), "--json"});
  EXPECT_EQ(checked.ending, "exit code 0") << checked.out;
  EXPECT_THAT(checked.out, AllOf(HasSubstr("warning"), HasSubstr("nose"), HasSubstr("gas")));
  const Outcome outcome = Headless(kPlayground, {"--robot", robot.string() + "@0,0"});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  EXPECT_THAT(outcome.LastLine()["warnings"].dump(), HasSubstr("nose"));
}

TEST(BadInput, OverlappingRobotsAreReported) {
  ExpectOneSentence(Headless(kPlayground, {"--robot", "pebble@0,0", "--robot", "pebble@0.1,0"}), 3,
                    "no room at (0.1, 0)");
}

TEST(BadInput, RobotInsideAWallIsReported) {
  base::testing::TestFolder folder;
  const auto world = folder.Write("w.sdf",
                                  "<sdf version='1.9'><world name='w'><model "
                                  "name='wall'><static>true</static><pose>1 0 1 0 0 0</pose><link "
                                  "name='l'><collision name='c'><geometry><box><size>1 5 "
                                  "2</size></box></geometry></collision></link></model>"
                                  "</world></sdf>");
  ExpectOneSentence(Headless(world.string(), {"--robot", "pebble@1,0"}), 3, "wall");
}

TEST(BadInput, MissingBrokerIsReported) {
  ExpectOneSentence(Headless(kPlayground, {"--broker", "corbaloc::1.2@127.0.0.1:1/TradingService"}),
                    5, "127.0.0.1:1");
}

TEST(BadInput, BehaviourWithoutAnOfferIsReported) {
  ExpectOneSentence(Headless(kPlayground, {"--robot", "pebble@0,0", "--behaviour", "juggle"}), 4,
                    "juggle");
}

TEST(BadInput, BehaviourThatThrowsInInitIsReported) {
  const BrokerProcess broker;
  Running bad("../tests/bad_behaviour",
              {"--broker", broker.reference(), "--fault", "throw-in-init"});
  bad.AwaitLine("offered at");
  ExpectOneSentence(Headless(kPlayground, {"--broker", broker.reference(), "--robot", "pebble@0,0",
                                           "--behaviour", "bad"}),
                    4, "no thank you");
}

TEST(BadInput, BehaviourThatNeverReturnsIsDeclaredUnresponsive) {
  const BrokerProcess broker;
  Running bad("../tests/bad_behaviour", {"--broker", broker.reference(), "--fault", "never-wait"});
  bad.AwaitLine("offered at");
  const Outcome outcome =
      Headless(kPlayground, {"--broker", broker.reference(), "--robot", "pebble@0,0", "--behaviour",
                             "bad", "--deadline", "0.5"});
  ExpectOneSentence(outcome, 4, "unresponsive");
  EXPECT_DOUBLE_EQ(outcome.LastLine()["sim_time_s"], 1.0);  // the run continued
  EXPECT_EQ(outcome.LastLine()["robots"][0]["agent"], "unresponsive");
}

TEST(BadInput, KilledBehaviourIsReported) {
  const BrokerProcess broker;
  Running bad("../tests/bad_behaviour", {"--broker", broker.reference(), "--fault", "die"});
  bad.AwaitLine("offered at");
  const Outcome outcome = Headless(
      kPlayground, {"--broker", broker.reference(), "--robot", "pebble@0,0", "--behaviour", "bad"});
  ExpectOneSentence(outcome, 4, "dead");
  EXPECT_DOUBLE_EQ(outcome.LastLine()["sim_time_s"], 1.0);
}

TEST(BadInput, ThrowingBehaviourIsReportedWithItsException) {
  const BrokerProcess broker;
  Running bad("../tests/bad_behaviour", {"--broker", broker.reference(), "--fault", "throw"});
  bad.AwaitLine("offered at");
  const Outcome outcome = Headless(
      kPlayground, {"--broker", broker.reference(), "--robot", "pebble@0,0", "--behaviour", "bad"});
  ExpectOneSentence(outcome, 4, "its run ended with an error: out of ideas");
  EXPECT_DOUBLE_EQ(outcome.LastLine()["sim_time_s"], 1.0);
  const auto robot = outcome.LastLine()["robots"][0];
  EXPECT_EQ(robot["agent"], "dead");
  EXPECT_NEAR(robot["distance_m"], 0.02, 1e-3);  // the robot drives 0.2 s at 0.1 m/s and then stops
}

TEST(BadInput, FailurePolicyEndsTheRun) {
  const BrokerProcess broker;
  Running bad("../tests/bad_behaviour", {"--broker", broker.reference(), "--fault", "die"});
  bad.AwaitLine("offered at");
  const Outcome outcome =
      Headless(kPlayground, {"--broker", broker.reference(), "--robot", "pebble@0,0", "--behaviour",
                             "bad", "--on-failure", "fail"});
  ExpectOneSentence(outcome, 4, "the run failed");
  EXPECT_LT(outcome.LastLine()["sim_time_s"], 1.0);
}

TEST(BadInput, FullDiskEndsOnlyTheRecording) {
  const Outcome outcome = Headless(
      kPlayground, {"--robot", "pebble@0,0", "--behaviour", "wander", "--record", "/dev/full"});
  ExpectOneSentence(outcome, 5, "/dev/full");
}

// A listening socket, which occupies its port.
class TakenPort {
 public:
  TakenPort() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), length), 0);
    EXPECT_EQ(listen(socket_, 1), 0);
    EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &length), 0);
    port_ = std::to_string(ntohs(address.sin_port));
  }
  ~TakenPort() { close(socket_); }
  const std::string& port() const { return port_; }

 private:
  const int socket_;
  std::string port_;
};

TEST(BadInput, InvalidViewerAddressIsReported) {
  ExpectOneSentence(RunProgram("gsv", {"view", "ftp://127.0.0.1:8080/"}), 2,
                    "ftp://127.0.0.1:8080/: cannot be used as the address of a viewer: it must "
                    "begin with http:// or https://");
}

TEST(BadInput, UsedViewerPortIsReported) {
  const TakenPort taken;
  const Outcome outcome =
      RunProgram("gsv", {"run", kPlayground, "--port", taken.port(), "--duration", "1"});
  ExpectOneSentence(outcome, 5, taken.port());
}

TEST(BadInput, UsedBrokerPortIsReported) {
  const TakenPort taken;
  const Outcome outcome = RunProgram("gsv", {"broker", "--port", taken.port(), "--memory"});
  EXPECT_EQ(outcome.ending, "exit code 5");
  EXPECT_THAT(outcome.err, HasSubstr(taken.port()));
}

// The rasteriser renders images if no driver is available.
TEST(BadInput, CamerasWorkWithoutEgl) {
  setenv("EGL_PLATFORM", "nonsense", 1);
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json", 1);
  const Outcome outcome = Headless(kPlayground, {"--robot", "b21r@0,0", "--behaviour", "wander"});
  unsetenv("EGL_PLATFORM");
  unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  EXPECT_THAT(outcome.err, Not(HasSubstr("no cameras: ")));
  EXPECT_GT(outcome.LastLine()["robots"][0]["readings"]["sonar"], 0);
  EXPECT_GT(outcome.LastLine()["robots"][0]["readings"]["camera"], 0);
}

}  // namespace
}  // namespace gsv::testing
