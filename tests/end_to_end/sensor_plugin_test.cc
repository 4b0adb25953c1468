// Tests a sensor type from outside the source tree. The example examples/infrared is built, loaded,
// recorded, shown, and read through its own IDL interface.
#include <cmath>
#include <cstdlib>
#include <mutex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/orb/orb.h"
#include "idl/simulation.hh"
#include "tests/end_to_end/served.h"
#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using Strings = std::vector<std::string>;

// The sensor is 0.1 m ahead of the robot's centre, and the wall is 0.5 m ahead of the centre.
constexpr double kDistance = 0.4;

constexpr const char* kWorld = R"(<sdf version='1.9'><world name='w'>
  <model name='wall'><static>true</static><pose>0.6 0 0.5 0 0 0</pose><link name='l'>
    <collision name='c'><geometry><box><size>0.2 4 1</size></box></geometry></collision>
  </link></model></world></sdf>)";

constexpr const char* kRobot = R"(<sdf version='1.9'><model name='r'><link name='l'>
    <collision name='c'><pose>0 0 0.1 0 0 0</pose>
      <geometry><cylinder><radius>0.05</radius><length>0.2</length></cylinder></geometry></collision>
    <sensor name='ir' type='infrared'><pose>0.1 0 0.1 0 0 0</pose></sensor>
  </link>
  <plugin filename='gz-sim-velocity-control-system' name='gz::sim::systems::VelocityControl'/>
  </model></sdf>)";

class SensorPlugin : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new base::testing::TestFolder;
    const std::string source = std::getenv("GSV_SOURCE_DIR"), build = std::getenv("GSV_BUILD_DIR");
    const std::string out = build + "/tests/infrared";
    // Each test is a separate process. The first test builds the example, and the others wait for
    // that.
    const Outcome built = RunProgram(
        "/usr/bin/flock", {build + "/tests/infrared.lock", "sh", "-ec",
                           R"(cmake -S "$1/examples/infrared" -B "$3" -DGSV_SOURCE_DIR="$1" \
                                -DGSV_BUILD_DIR="$2"
                              cmake --build "$3")",
                           "sh", source, build, out});
    ASSERT_EQ(built.ending, "exit code 0") << built.out << built.err;
    plugin_ = out + "/gsv-sensor-infrared.so";
  }
  static void TearDownTestSuite() { delete folder_; }

  SensorPlugin()
      : world_(folder_->Write("world.sdf", kWorld)), robot_(folder_->Write("r.sdf", kRobot)) {}

  Outcome RunWith(Strings more) const {
    Strings arguments{"run",           world_,       "--robot",
                      robot_ + "@0,0", "--headless", "--lockstep",
                      "--json",        "--duration", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram("gsv", arguments);
  }

  static inline base::testing::TestFolder* folder_ = nullptr;
  static inline std::string plugin_;
  const std::string world_, robot_;
};

TEST_F(SensorPlugin, IsRecordedAndDrawn) {
  const std::string file = folder_->path() / "run.mcap";
  const Outcome run = RunWith({"--sensor-plugin", plugin_, "--record", file});
  ASSERT_EQ(run.ending, "exit code 0") << run.err;
  const Outcome readings = RunProgram("gsv", {"rec", "cat", file, "--topic", "/r/ir"});
  ASSERT_EQ(readings.ending, "exit code 0") << readings.err;
  const std::string last =
      readings.out.substr(readings.out.rfind('\n', readings.out.size() - 2) + 1);
  const auto message = nlohmann::json::parse(last).at("message");
  EXPECT_EQ(message.at("radiation_type"), 1) << last;
  EXPECT_NEAR(message.at("range").get<double>(), kDistance, 1e-6) << last;
  const Outcome beams = RunProgram("gsv", {"rec", "cat", file, "--topic", "/gsv/beams"});
  const auto drawn = nlohmann::json::parse(beams.out.substr(0, beams.out.find('\n')));
  EXPECT_EQ(drawn.at("/message/markers/0/points"_json_pointer).size(), 2u) << drawn;
}

TEST_F(SensorPlugin, IsFoundOnThePluginPath) {
  ASSERT_EQ(setenv("GSV_SENSOR_PLUGIN_PATH",
                   ("/nowhere:" + plugin_.substr(0, plugin_.rfind('/'))).c_str(), 1),
            0);
  const std::string file = folder_->path() / "path.mcap";
  const Outcome run = RunWith({"--record", file});
  unsetenv("GSV_SENSOR_PLUGIN_PATH");
  ASSERT_EQ(run.ending, "exit code 0") << run.err;
  EXPECT_THAT(RunProgram("gsv", {"rec", "info", file}).out, HasSubstr("/r/ir"));
}

TEST_F(SensorPlugin, InvalidLibraryIsRejectedWithASentence) {
  const auto text = folder_->Write("gsv-sensor-text.so", "no library");
  const Outcome no_library = RunWith({"--sensor-plugin", text.string()});
  EXPECT_NE(no_library.ending, "exit code 0");
  EXPECT_THAT(no_library.err, HasSubstr("cannot be loaded as a sensor plug-in"));
  const Outcome twice = RunWith({"--sensor-plugin", plugin_, "--sensor-plugin", plugin_});
  EXPECT_NE(twice.ending, "exit code 0");
  EXPECT_THAT(twice.err, HasSubstr("another type has it"));
}

// A behaviour that reads the sensor through the plug-in's interface, which is not compiled into
// this test.
class ReadsInInit final : public POA_sba::AgentBehaviour {
 public:
  void init(const char*, sba::Hardware_ptr robot) override {
    const sba::SensorFactory_var factory = robot->sensor_factory();
    const sba::Sensor_var sensor = factory->open("ir");
    is_typed = sensor->_is_a("IDL:example/infrared/ProximitySensor:1.0");
    const CORBA::Request_var request = sensor->_request("distance");
    request->set_return_type(CORBA::_tc_double);
    request->invoke();
    CORBA::Double value = 0;
    if (request->return_value() >>= value) distance = value;
  }
  void start() override {}
  void stop() override {}
  void pause() override {}
  void resume() override {}
  void destroy() override {}

  bool is_typed = false;
  double distance = std::nan("");
};

TEST_F(SensorPlugin, IsReadThroughItsOwnInterface) {
  const BrokerProcess broker;
  Running server(
      "gsv", {"serve", "--broker", broker.reference(), "--headless", "--sensor-plugin", plugin_});
  server.AwaitLine("broker: ");
  auto orb = StartOrbWithLongTimeout();
  ASSERT_TRUE(orb);
  {
    auto client = broker::BrokerClient::Connect(*orb, broker.reference());
    ASSERT_TRUE(client);
    const auto offers = client->Query(broker::SimulationServiceType().name, "", "first", 1);
    ASSERT_TRUE(offers);
    const sba::SimulationService_var service =
        sba::SimulationService::_narrow(offers->front().object);
    sba::SimulationSpecification specification;
    specification.world = world_.c_str();
    specification.pacing = sba::LOCKSTEP;
    specification.factor = 1;
    specification.step_ns = 0;
    specification.seed = 1;
    specification.duration_ns = 0;
    specification.keep = true;
    const sba::Simulation_var simulation = service->create_simulation(specification);
    const PortableServer::POA_var poa = orb::RootPoa(*orb);
    const PortableServer::Servant_var<ReadsInInit> behaviour(new ReadsInInit);
    const PortableServer::ObjectId_var id = poa->activate_object(behaviour.in());
    sba::RobotSpecification robot;
    robot.model = robot_.c_str();
    robot.start = {0, 0, 0, 0, 0, 0};
    robot.behaviour = behaviour.in()->_this();
    const CORBA::String_var name(simulation->add_robot(robot));
    EXPECT_TRUE(behaviour.in()->is_typed);
    EXPECT_NEAR(behaviour.in()->distance, kDistance, 1e-6);
    poa->deactivate_object(id);
  }
  (*orb)->destroy();
}

}  // namespace
}  // namespace gsv::testing
