#include "gsv/health/health_tracker.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/sensing/devices/built_in.h"

namespace gsv::health {
namespace {

using namespace std::chrono_literals;
using simulation::AgentPhase;

simulation::RobotStatus Robot(const std::string& name = "pebble") {
  simulation::RobotStatus robot;
  robot.name = name;
  robot.behaviour = "wander";
  robot.phase = AgentPhase::kWaiting;
  robot.motion.has_moved = true;
  robot.motion.since = 15700ms;
  return robot;
}

simulation::SimulationStatus At(base::SimTime time, std::vector<simulation::RobotStatus> robots) {
  simulation::SimulationStatus status;
  status.phase = simulation::Phase::kRunning;
  status.time = time;
  status.robots = std::move(robots);
  return status;
}

RobotHealth HealthOf(const simulation::RobotStatus& robot) {
  return health::HealthOf(robot, At(35700ms, {robot}));
}

TEST(Health, ARobotThatStandsHasItsCommandAndItsNearestRangeAsReasons) {
  RobotHealth health = HealthOf(Robot());
  SetLimit(Limit{"sonar_00", 0.257}, health);
  EXPECT_EQ(health.state, State::kStanding);
  EXPECT_EQ(Sentence(health, 35700ms),
            "has not moved for 20 s: commanded 0, sonar_00 reads 0.26 m");
  EXPECT_EQ(FinalSentence(health), "stood still from 15.7 s: commanded 0, sonar_00 reads 0.26 m");
  RobotHealth close = HealthOf(Robot());
  SetLimit(Limit{"lidar", -std::numeric_limits<double>::infinity()}, close);
  EXPECT_EQ(Sentence(close, 35700ms),
            "has not moved for 20 s: commanded 0, lidar reads less than its minimum range");
}

TEST(Health, StandingIsAWarningAfterTenSecondsIfItsBehaviourRuns) {
  simulation::RobotStatus robot = Robot();
  const auto level = [&](base::SimTime now) {
    return health::HealthOf(robot, At(now, {robot})).level;
  };
  EXPECT_EQ(level(25600ms), Level::kFine);
  EXPECT_EQ(level(25700ms), Level::kWarning);
  robot.phase = AgentPhase::kFinished;
  EXPECT_EQ(level(25700ms), Level::kFine);
  robot.phase = AgentPhase::kNone;
  robot.behaviour.clear();
  EXPECT_EQ(level(25700ms), Level::kFine);
  EXPECT_EQ(HealthOf(robot).reason, "it has no behaviour, and no command to move");
}

TEST(Health, ARobotThatMovesHasNoWarning) {
  simulation::RobotStatus robot = Robot();
  robot.motion.is_moving = true;
  robot.motion.command.linear = 0.3;
  robot.motion.linear = 0.29;
  const RobotHealth health = HealthOf(robot);
  EXPECT_EQ(health.state, State::kMoving);
  EXPECT_EQ(health.level, Level::kFine);
  EXPECT_EQ(Sentence(health, 18700ms), "has been moving for 3.0 s: commanded 0.3 m/s");
  EXPECT_EQ(FinalSentence(health), "");
}

TEST(Health, AStuckRobotNamesCommandAndContactPartner) {
  simulation::RobotStatus robot = Robot();
  robot.motion.is_stuck = true;
  robot.motion.command = {.linear = 0.3, .angular = -0.5};
  robot.motion.contact = "shelf_3";
  const RobotHealth health = HealthOf(robot);
  EXPECT_EQ(health.state, State::kStuck);
  EXPECT_EQ(health.level, Level::kWarning);
  EXPECT_EQ(Sentence(health, 35700ms),
            "has been stuck for 20 s: commanded 0.3 m/s and -0.5 rad/s, touches shelf_3");
}

TEST(Health, AContactIsReportedWithTheTimeSinceItBegan) {
  simulation::RobotStatus robot = Robot();
  robot.motion.is_moving = true;
  robot.motion.contact = "wall";
  robot.motion.contact_since = 30s;
  const RobotHealth health = HealthOf(robot);
  EXPECT_EQ(health.state, State::kContact);
  EXPECT_EQ(Sentence(health, 32500ms), "has been in contact for 2.5 s: commanded 0, touches wall");
}

TEST(Health, ADeadBehaviourIsAnError) {
  simulation::RobotStatus robot = Robot();
  robot.phase = AgentPhase::kDead;
  robot.detail = "its process has ended or refuses connections";
  robot.detail_since = 5s;
  const RobotHealth health = HealthOf(robot);
  EXPECT_EQ(health.level, Level::kError);
  EXPECT_EQ(FinalSentence(health),
            "was dead from 5.0 s: its behaviour wander died: its process has ended or refuses "
            "connections");
}

TEST(Health, TheReasonOfADeathIsTheException) {
  simulation::RobotStatus robot = Robot();
  robot.phase = AgentPhase::kDead;
  robot.cause = "too far";
  robot.detail = "its run ended with an error: too far";
  EXPECT_EQ(HealthOf(robot).reason, "its behaviour wander died: too far");
}

TEST(Health, SeverityOrdersStatesFromTheWorst) {
  const std::vector<State> worst_first{State::kDead, State::kStuck,    State::kContact,
                                       State::kLate, State::kStanding, State::kMoving};
  for (std::size_t i = 1; i < worst_first.size(); ++i) {
    EXPECT_GT(Severity(worst_first[i - 1], Level::kFine), Severity(worst_first[i], Level::kError));
    EXPECT_EQ(StateOf(ToString(worst_first[i])), worst_first[i]);
  }
  EXPECT_GT(Severity(State::kStanding, Level::kWarning), Severity(State::kStanding, Level::kFine));
  EXPECT_EQ(StateOf("asleep"), std::nullopt);
}

TEST(Health, ABehaviourThatDoesNotWaitIsLate) {
  simulation::RobotStatus robot = Robot();
  robot.running_for = 2s;
  simulation::SimulationStatus status = At(20s, {robot});
  EXPECT_EQ(health::HealthOf(robot, status).reason,
            "its behaviour wander runs without calling a wait function");
  status.mode = simulation::Mode::kLockstep;
  EXPECT_EQ(health::HealthOf(robot, status).state, State::kLate);
  EXPECT_EQ(health::HealthOf(robot, status).reason,
            "the simulation waits for its behaviour wander");
  status.phase = simulation::Phase::kPaused;
  EXPECT_EQ(health::HealthOf(robot, status).state, State::kStanding);
}

// Makes robots with one sonar each, and counts readings of the sonars.
class HealthTrackerTest : public ::testing::Test {
 protected:
  HealthTrackerTest() {
    sensing::AddBuiltInSensors(types_);
    access_.types = &types_;
    access_.sensors = [](const std::string&) {
      model::SensorDescription sonar;
      sonar.name = "front";
      sonar.type = "sonar";
      model::SensorDescription compass;
      compass.name = "compass";
      compass.type = "magnetometer";
      return std::vector{sonar, compass};
    };
    access_.read = [this](const std::string&, const std::string& sensor) {
      ++readings_;
      EXPECT_EQ(sensor, "front");
      sensing::Reading reading;
      reading.values.push_back(range_);
      return base::Result<sensing::Reading>(reading);
    };
  }

  sensing::SensorRegistry types_;
  SensorAccess access_;
  int readings_ = 0;
  double range_ = 0.4;
};

TEST_F(HealthTrackerTest, CountsRobotsByStateWithoutStations) {
  simulation::RobotStatus moving = Robot("a"), station = Robot("camera");
  moving.motion.is_moving = true;
  station.is_station = true;
  HealthTracker tracker;
  const Report report =
      tracker.Update(At(20s, {moving, Robot("b"), Robot("c"), station}), 5s, access_);
  EXPECT_EQ(report.CountOf(State::kMoving), 1u);
  EXPECT_EQ(report.CountOf(State::kStanding), 2u);
  EXPECT_EQ(Summary(report), "1 moves, 2 stand");
  ASSERT_EQ(report.robots.size(), 3u);
  EXPECT_EQ(report.robots[1].limit, (Limit{"front", 0.4}));
}

TEST_F(HealthTrackerTest, ReadsTheSensorsOfARobotThatStandsEveryFiveSeconds) {
  HealthTracker tracker;
  for (base::SimTime now = 16s; now < 21s; now += 500ms) {
    (void)tracker.Update(At(now, {Robot()}), 5s, access_);
  }
  EXPECT_EQ(readings_, 1);
  range_ = 0.3;
  const Report report = tracker.Update(At(21s, {Robot()}), 5s, access_);
  EXPECT_EQ(readings_, 2);
  EXPECT_EQ(report.robots[0].limit->value, 0.3);
}

TEST_F(HealthTrackerTest, ReadsTheSensorsOfALimitedNumberOfRobots) {
  HealthTracker tracker(2);
  std::vector<simulation::RobotStatus> robots;
  for (const char* name : {"a", "b", "c", "d", "e"}) robots.push_back(Robot(name));
  (void)tracker.Update(At(20s, robots), 5s, access_);
  EXPECT_EQ(readings_, 2);
  (void)tracker.Update(At(20s, robots), 5s, access_);
  const Report report = tracker.Update(At(20s, robots), 5s, access_);
  EXPECT_EQ(readings_, 5);
  EXPECT_TRUE(report.robots[4].limit);
}

TEST_F(HealthTrackerTest, IntensitiesOfALidarAreNoRanges) {
  access_.sensors = [](const std::string&) {
    model::SensorDescription lidar;
    lidar.name = "lidar";
    lidar.type = "lidar";
    lidar.parameters["intensity_scale"] = 100.0;
    return std::vector{lidar};
  };
  access_.read = [](const std::string&, const std::string&) {
    sensing::Reading reading;
    reading.values = {3, 0.7, 2, 40, 20, 0};  // three ranges and three intensities
    return base::Result<sensing::Reading>(reading);
  };
  HealthTracker tracker;
  const Report report = tracker.Update(At(20s, {Robot()}), 5s, access_);
  ASSERT_EQ(report.robots.size(), 1u);
  EXPECT_EQ(report.robots[0].limit, (Limit{"lidar", 0.7}));
}

TEST_F(HealthTrackerTest, ARangeOfMoreThanAMetreIsNotReportedAsObstacle) {
  range_ = 1.5;
  HealthTracker tracker;
  EXPECT_FALSE(tracker.Update(At(20s, {Robot()}), 5s, access_).robots[0].limit);
}

}  // namespace
}  // namespace gsv::health
