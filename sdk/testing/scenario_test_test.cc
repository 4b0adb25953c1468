// Uses the fixtures of sdk/testing as the tests of a user do.
#include "sdk/testing/scenario_test.h"

#include <cstdlib>
#include <fstream>
#include <future>
#include <memory>

#include <gtest/gtest-spi.h>

#include "gsv/base/temporary_folder.h"

namespace gsv::testing {
namespace {

class Here : public ::testing::Environment {
  void SetUp() override {
    const std::string program = std::string(std::getenv("GSV_BUILD_DIR")) + "/bin/gsv";
    setenv("GSV_PROGRAM", program.c_str(), 0);
  }
};
const auto* const here = ::testing::AddGlobalTestEnvironment(new Here);

TEST(ScenarioFixture, RunsAScenarioAsATest) {
  const auto folder = base::TemporaryFolder::Make("gsv-fixture");
  ASSERT_TRUE(folder);
  const std::string file = folder->path() / "still.yaml", failures = folder->path() / "failures";
  std::ofstream(file) << "world: playground\nduration: 1\nrobots: [{model: pebble, x: 0, y: 0}]\n"
                         "expect: [{always: {speed: {robot: pebble, at_most: 0}}}]\n";
  ExpectPasses(file, {"--no-record", "--failures", failures});
  static std::string moving, to;
  moving = folder->path() / "moving.yaml";
  to = failures;
  std::ofstream(moving) << "world: playground\nduration: 1\n"
                           "robots: [{model: pebble, x: 0, y: 0}]\n"
                           "expect: [{eventually: {speed: {robot: pebble, at_least: 1}}}]\n";
  EXPECT_NONFATAL_FAILURE(ExpectPasses(moving, {"--no-record", "--failures", to}),
                          "violated at 1 s");
}

using ASimulator = SimulatorTest;

TEST_F(ASimulator, RunsTheScenarioOfATest) {
  auto simulation = simulator().Create({.world = "playground"});
  ASSERT_TRUE(simulation) << simulation.error().Sentence();
  ASSERT_TRUE((*simulation)->AddRobot({.model = "pebble", .x = 1, .y = 2}));
  ASSERT_TRUE((*simulation)->RunUntil(std::chrono::seconds(1)));
  const auto state = (*simulation)->State();
  ASSERT_TRUE(state);
  EXPECT_EQ(state->robots.at(0).place.x, 1);
  EXPECT_EQ(state->time, std::chrono::seconds(1));
}

TEST_F(ASimulator, ReportsAPauseBeforeTheInstant) {
  auto simulation = simulator().Create({.world = "playground", .lockstep = false});
  ASSERT_TRUE(simulation) << simulation.error().Sentence();
  bool is_paused = false;
  const auto pause = [&] {
    if (!is_paused) {
      EXPECT_TRUE((*simulation)->Pause());
    }
    return is_paused = true;
  };
  const auto ran = (*simulation)->RunUntil(1h, 60s, pause);
  ASSERT_FALSE(ran);
  EXPECT_EQ(ran.error().code, base::ErrorCode::kEnded);
  EXPECT_NE(ran.error().message.find("the simulation is paused at "), std::string::npos)
      << ran.error().message;
}

// A behaviour that sends the width of the image of its wide-angle camera to `seen`.
class Looks final : public Behaviour {
 public:
  explicit Looks(std::promise<int>& seen) : seen_(seen) {}
  base::Status Init(Robot& robot) override {
    auto camera = robot.OpenCamera("eye");
    if (!camera) return base::Fail(camera.error());
    camera_ = *std::move(camera);
    return {};
  }
  void Run(Robot& robot) override {
    if (robot.SleepFor(100ms)) seen_.set_value(camera_->TakeImage().width);
  }

 private:
  std::promise<int>& seen_;
  std::unique_ptr<Camera> camera_;
};

TEST_F(ASimulator, OpensAWideAngleCameraAsACamera) {
  const auto folder = base::TemporaryFolder::Make("gsv-fixture");
  ASSERT_TRUE(folder);
  const std::string model = folder->path() / "eye.sdf";
  std::ofstream(model)
      << "<sdf version='1.9'><model name='eye'><link name='base'><collision name='c'><geometry>"
         "<sphere><radius>0.1</radius></sphere></geometry></collision><sensor name='eye' "
         "type='wideanglecamera'><camera><horizontal_fov>2.5</horizontal_fov><image>"
         "<width>32</width><height>24</height></image></camera></sensor></link>"
         "<plugin filename='gz-sim-velocity-control-system' name='v'/></model></sdf>";
  auto simulation = simulator().Create({.world = "playground"});
  ASSERT_TRUE(simulation) << simulation.error().Sentence();
  std::promise<int> seen;
  const auto added = (*simulation)->AddRobot({.model = model, .own_behaviour = [&seen] {
                                                return std::make_unique<Looks>(seen);
                                              }});
  ASSERT_TRUE(added) << added.error().Sentence();
  ASSERT_TRUE((*simulation)->RunUntil(std::chrono::seconds(1)));
  EXPECT_EQ(seen.get_future().get(), 32);
}

}  // namespace
}  // namespace gsv::testing
