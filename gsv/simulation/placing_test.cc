// Tests changes of bodies and their poses while the simulation is paused.
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

geometry::Vector3 PositionOf(const Simulation& simulation, const std::string& name) {
  return StatusOf(simulation, name).world_from_robot.position;
}

void RunUntilPaused(Simulation& simulation, SimTime instant) {
  ASSERT_TRUE(simulation.RunUntil(instant));
  ASSERT_EQ(simulation.WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
}

TEST(Placing, BeforeTheFirstStepItSetsTheInitialPose) {
  auto simulation = Make(Lockstep(100ms));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0)));
  ASSERT_TRUE(simulation->PlaceBody("robot", PlanarPose(1, -2, 0, 0.5), true));
  EXPECT_EQ(PositionOf(*simulation, "robot"), (geometry::Vector3{1, -2, 0}));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE(simulation->Reset());
  const auto pose = StatusOf(*simulation, "robot").world_from_robot;
  EXPECT_EQ(pose.position, (geometry::Vector3{1, -2, 0}));
  EXPECT_NEAR(geometry::Yaw(pose.orientation), 0.5, 1e-12);
}

TEST(Placing, DuringAPauseMovesTheRobotUntilAReset) {
  auto simulation = Make(Lockstep(1s));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, Drives(0.5))));
  RunUntilPaused(*simulation, 500ms);
  ASSERT_TRUE(simulation->PlaceBody("robot", PlanarPose(-1, 2, 0, 0), true));
  EXPECT_EQ(PositionOf(*simulation, "robot"), (geometry::Vector3{-1, 2, 0}));
  ASSERT_TRUE(simulation->Resume());
  ASSERT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
  // The robot drives half a second at 0.5 m/s, without a limit on acceleration.
  EXPECT_NEAR(PositionOf(*simulation, "robot").x, -1 + 0.25, 1e-9);
  ASSERT_TRUE(simulation->Reset());
  EXPECT_EQ(PositionOf(*simulation, "robot"), (geometry::Vector3{0, 0, 0}));
}

TEST(Placing, OccupiedPlaceIsRejectedAndNothingMoves) {
  auto simulation = Make(Lockstep(0s));
  ASSERT_TRUE(simulation->AddRobot(Robot("first", 0, 0)));
  ASSERT_TRUE(simulation->AddRobot(Robot("second", 1, 0)));
  const auto into_another = simulation->PlaceBody("second", PlanarPose(0.1, 0, 0, 0), true);
  ASSERT_FALSE(into_another);
  EXPECT_NE(into_another.error().Sentence().find("\"first\""), std::string::npos);
  EXPECT_FALSE(simulation->PlaceBody("second", PlanarPose(3, 0, 0, 0), true));
  EXPECT_EQ(PositionOf(*simulation, "second"), (geometry::Vector3{1, 0, 0}));
  // The new pose may overlap the old pose of the same body.
  EXPECT_TRUE(simulation->PlaceBody("second", PlanarPose(1.05, 0, 0, 0), true));
}

TEST(Placing, IsRefusedForStaticAndMissingBodiesAndWhileRunning) {
  auto simulation = Make(Lockstep(0s));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0)));
  const auto wall = simulation->PlaceBody("wall", PlanarPose(1, 0, 0, 0), true);
  ASSERT_FALSE(wall);
  EXPECT_NE(wall.error().message.find("fixed"), std::string::npos);
  EXPECT_EQ(simulation->PlaceBody("nobody", {}, true).error().code, base::ErrorCode::kNotFound);
  ASSERT_TRUE(simulation->Start());
  const auto running = simulation->PlaceBody("robot", PlanarPose(1, 0, 0, 0), true);
  ASSERT_FALSE(running);
  EXPECT_EQ(running.error().code, base::ErrorCode::kNotRunning);
  EXPECT_TRUE(simulation->Stop());
}

TEST(Placing, ARobotAddedDuringAPauseDrivesAfterIt) {
  auto simulation = Make(Lockstep(1s));
  ASSERT_TRUE(simulation->AddRobot(Robot("first", 0, 0, Drives(0.5))));
  RunUntilPaused(*simulation, 500ms);
  ASSERT_TRUE(simulation->AddRobot(Robot("second", 0, 2, Drives(0.5))));
  ASSERT_TRUE(simulation->Resume());
  ASSERT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
  EXPECT_NEAR(PositionOf(*simulation, "first").x, 0.5, 1e-9);
  EXPECT_NEAR(PositionOf(*simulation, "second").x, 0.25, 1e-9);
}

// Returns a disc with a sensor that samples at 10 Hz, and one whose samples of 2 Hz come 0.5 s late.
std::shared_ptr<model::Model> DiscWithSlowSensors() {
  auto model = std::make_shared<model::Model>(*Disc(0.2));
  for (const double rate : {10.0, 2.0}) {
    model::SensorDescription sensor;
    sensor.name = rate == 10 ? "quick" : "late";
    sensor.type = "positioning";
    sensor.update_rate = rate;
    if (rate == 2) sensor.parameters["latency"] = 0.5;
    model->sensors.push_back(sensor);
  }
  return model;
}

TEST(Placing, TheSamplesOfOtherRobotsStayAsTheyAre) {
  auto simulation = Make(Lockstep(3s));
  RobotSpecification robot = Robot("robot", 0, 0, Drives(0.5));
  robot.model = DiscWithSlowSensors();
  ASSERT_TRUE(simulation->AddRobot(robot));
  ASSERT_TRUE(simulation->AddRobot(Robot("other", 0, 4)));
  const auto times = [&] {
    const auto quick = simulation->Watch("robot", "quick"),
               late = simulation->Watch("robot", "late");
    return std::pair(quick->time, late->time);
  };
  RunUntilPaused(*simulation, 1250ms);
  EXPECT_EQ(times(), std::pair(SimTime(1200ms), SimTime(500ms)));
  ASSERT_TRUE(simulation->PlaceBody("other", PlanarPose(0, -4, 0, 0), true));
  ASSERT_TRUE(simulation->AddRobot(Robot("a", 0, 2)));
  EXPECT_EQ(times(), std::pair(SimTime(1200ms), SimTime(500ms)));
  RunUntilPaused(*simulation, 1550ms);
  EXPECT_EQ(times(), std::pair(SimTime(1500ms), SimTime(1000ms)));
  EXPECT_NEAR(simulation->Watch("robot", "late")->values[0], 0.5, 1e-9);
}

TEST(Placing, ARobotAtAWallStillTouchesIt) {
  auto simulation = Make(Lockstep(9s));
  RobotSpecification robot = Robot("robot", 2.5, 0, Drives(0.5));
  auto model = std::make_shared<model::Model>(*robot.model);
  model::SensorDescription bumper;
  bumper.name = bumper.type = "contact";
  model->sensors.push_back(bumper);
  robot.model = model;
  ASSERT_TRUE(simulation->AddRobot(robot));
  ASSERT_TRUE(simulation->AddRobot(Robot("other", 0, 4)));
  RunUntilPaused(*simulation, 2s);
  const auto touched = [&] { return *simulation->Watch("robot", "contact")->labels; };
  ASSERT_EQ(touched(), std::vector<std::string>{"wall"});
  ASSERT_TRUE(simulation->PlaceBody("other", PlanarPose(0, -4, 0, 0), true));
  EXPECT_EQ(touched(), std::vector<std::string>{"wall"});
  ASSERT_TRUE(simulation->PlaceBody("robot", PlanarPose(0, 0, 0, 0), true));
  EXPECT_EQ(touched(), std::vector<std::string>{});
}

}  // namespace
}  // namespace gsv::simulation
