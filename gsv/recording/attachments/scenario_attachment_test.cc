#include "gsv/recording/attachments/scenario_attachment.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/simulation_recorder.h"
#include "gsv/recording/testing/test_simulation.h"
#include "gsv/scenario/scenario_file.h"

namespace gsv::recording {
namespace {

// A world with a robot at (1, -2), with a yaw of 1.5 rad, and an avatar.
std::shared_ptr<simulation::Simulation> Room() {
  simulation::Specification specification = simulation::Lockstep(3s);
  specification.seed = 9;
  auto simulation = simulation::Make(std::move(specification));
  simulation::RobotSpecification robot = Robot("robot", 0, Drives(0.5));
  robot.world_from_robot = geometry::PlanarPose(1, -2, 0, 1.5);
  EXPECT_TRUE(simulation->AddRobot(robot));
  simulation::RobotSpecification avatar = Robot("Ann", 2, nullptr);
  avatar.is_avatar = true;
  EXPECT_TRUE(simulation->AddRobot(avatar));
  return simulation;
}

TEST(ScenarioAttachment, ContainsTheSettingsOfTheSimulation) {
  const auto simulation = Room();
  const scenario::Scenario scenario = ScenarioOf(*simulation);
  EXPECT_EQ(scenario.world, simulation->specification().world->name);
  EXPECT_EQ(scenario.name, "simulation");
  EXPECT_EQ(scenario.seed, 9u);
  EXPECT_EQ(scenario.lockstep, true);
  EXPECT_EQ(scenario.step, 0.01);
  EXPECT_EQ(scenario.duration, 3);
  EXPECT_EQ(scenario.fails_with_behaviour, false);
  ASSERT_EQ(scenario.robots.size(), 1u);
  const scenario::RobotEntry& robot = scenario.robots[0];
  EXPECT_EQ(robot.name, "robot");
  EXPECT_FALSE(robot.model.empty());
  EXPECT_EQ(robot.behaviour, "test");
  EXPECT_EQ(robot.movement, std::nullopt);
  ASSERT_TRUE(robot.start);
  EXPECT_EQ(robot.start->x, 1);
  EXPECT_EQ(robot.start->y, -2);
  EXPECT_NEAR(robot.start->yaw, 1.5, 1e-15);
  ASSERT_EQ(scenario.avatars.size(), 1u);
  EXPECT_EQ(scenario.avatars[0].name, "Ann");
}

// Returns the scenario that is attached to the recording at `path`, and removes the file.
std::string AttachedTo(const std::string& path) {
  const auto reader = McapReader::Open(path);
  EXPECT_TRUE(reader);
  std::string text;
  for (const AttachmentIndexRecord& index : (*reader)->summary().attachments) {
    if (index.name != kScenarioAttachment) continue;
    EXPECT_EQ(index.media_type, kScenarioMediaType);
    EXPECT_EQ(text, "") << "it is attached once";
    const auto attachment = (*reader)->Read(index).value();
    text.assign(reinterpret_cast<const char*>(attachment.data.data()), attachment.data.size());
  }
  std::filesystem::remove(path);
  return text;
}

RecorderOptions Options() {
  RecorderOptions options;
  options.write_glb = [](const model::Model&) {
    return base::Result<std::vector<std::uint8_t>>(std::vector<std::uint8_t>(1));
  };
  options.replace = true;
  return options;
}

TEST(ScenarioAttachment, IsInEachRecordingAndCanBeParsed) {
  const std::string path = ::testing::TempDir() + "gsv_scenario.mcap";
  const auto simulation = Room();
  ASSERT_TRUE(SimulationRecorder::Start(simulation, path, Options()).value()->Stop());
  base::Problems problems;
  const auto scenario = scenario::ParseScenario(AttachedTo(path), path, problems);
  ASSERT_TRUE(scenario) << scenario.error().Sentence();
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(*scenario, ScenarioOf(*simulation));
}

TEST(ScenarioAttachment, IsTheOriginalScenarioIfTheOptionsHaveOne) {
  const std::string path = ::testing::TempDir() + "gsv_scenario_told.mcap";
  RecorderOptions options = Options();
  options.scenario = scenario::DefaultScenario();
  ASSERT_TRUE(SimulationRecorder::Start(Room(), path, std::move(options)).value()->Stop());
  EXPECT_EQ(AttachedTo(path), scenario::ToYaml(scenario::DefaultScenario()));
}

}  // namespace
}  // namespace gsv::recording
