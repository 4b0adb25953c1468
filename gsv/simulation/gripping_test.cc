// Tests grippers: which bodies they grasp, how grasped bodies move, and when they are released.
#include <cmath>

#include "gsv/base/test_within.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

constexpr double kWidth = 0.06;  // width of the post, m
constexpr double kMass = 0.3;    // kg

// A dynamic post for the gripper.
model::PlacedModel Post(const std::string& name, double x, double y) {
  auto model = std::make_shared<model::Model>();
  model->name = "post";
  model->links.resize(1);
  model->links[0].name = "post";
  model->links[0].inertial = {kMass, {}, 1e-3, 1e-3, 1e-3};
  model->links[0].collisions.push_back({"post", {}, geometry::Box{{kWidth, kWidth, 0.2}}, {}});
  return {name, std::move(model), geometry::Pose{{x, y, 0.1}, {}}, false};
}

// A world with a wall at x = 3, level ground, and posts.
std::shared_ptr<Simulation> WithPosts(SimTime duration, std::vector<model::PlacedModel> posts) {
  Specification specification = Lockstep(duration);
  auto world = std::make_shared<model::WorldDescription>(*specification.world);
  auto ground = std::make_shared<model::Model>();
  ground->links.resize(1);
  ground->links[0].collisions.push_back({"ground", {}, geometry::Plane{}, {}});
  world->models.push_back({"ground", ground, {}, true});
  for (model::PlacedModel& post : posts) world->models.push_back(std::move(post));
  specification.world = world;
  return Make(specification);
}

// A disc of 0.2 m radius, with a gripper in front of it that opens to 0.1 m.
RobotSpecification RobotWithGripper(std::string name, double x, double y,
                                    std::shared_ptr<BehaviourPort> behaviour = nullptr,
                                    double yaw = 0) {
  RobotSpecification robot = Robot(std::move(name), x, y, std::move(behaviour));
  robot.world_from_robot = PlanarPose(x, y, 0, yaw);
  auto model = std::make_shared<model::Model>(*robot.model);
  model::SensorDescription gripper;
  gripper.name = gripper.type = "gripper";
  gripper.link_from_sensor.position = {0.2, 0, 0.1};
  model->sensors.push_back(gripper);
  robot.model = std::move(model);
  return robot;
}

std::string HeldBy(Simulation& simulation, const std::string& robot) {
  const auto reading = simulation.Watch(robot, "gripper");
  EXPECT_TRUE(reading) << reading.error().Sentence();
  return reading ? reading->labels->front() : "";
}

void RunTo(Simulation& simulation, SimTime instant) {
  ASSERT_TRUE(simulation.RunUntil(instant));
  ASSERT_EQ(simulation.WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
}

// A behaviour that closes the gripper at once and drives from 1 s to 2 s. If `opens` is true, it
// then opens the gripper and drives away.
std::shared_ptr<ThreadBehaviour> Fetches(world::DriveCommand drive, bool opens = true,
                                         std::chrono::microseconds dawdling = 0us) {
  return std::make_shared<ThreadBehaviour>([=](Agent& agent, ClockId clock) {
    ASSERT_TRUE(agent.CommandDevice("gripper", {{0}, ""}));
    if (!SleepFor(agent, clock, 1s)) return;
    std::this_thread::sleep_for(dawdling);
    (void)agent.Command(drive);
    if (!SleepFor(agent, clock, 1s)) return;
    std::this_thread::sleep_for(dawdling);
    (void)agent.Command({});
    if (opens) (void)agent.CommandDevice("gripper", {{1}, ""});
    if (!SleepFor(agent, clock, 1s)) return;
    (void)agent.Command({-0.1, 0, 0});
    while (SleepFor(agent, clock, 1s)) {
    }
  });
}

// Returns the maximum time, in s, for which the post rocks. The post starts at nine tenths of the
// angle at which it would fall. The formulas for the energy after an impact and for the time
// between two impacts are from G. W. Housner, "The behavior of inverted pendulum structures during
// earthquakes", Bulletin of the Seismological Society of America 53 (1963).
double RockingTime() {
  const double half = kWidth / 2, height = 0.1, r = std::hypot(half, height);
  const double inertia = 1e-3 + kMass * r * r;  // moment of inertia about an edge
  const double falls = std::atan(half / height);
  const double left = std::pow(1 - kMass * r * r / inertia * (1 - std::cos(2 * falls)), 2);
  const double rate = std::sqrt(kMass * 9.8 * r / inertia);
  // The energy is given as a fraction of the energy at which the post falls. The time between
  // impacts is 2 / rate × artanh(√energy).
  double energy = 1 - 0.1 * 0.1, time = std::atanh(std::sqrt(energy)) / rate;
  while ((energy *= left) > 1e-9) time += 2 / rate * std::atanh(std::sqrt(energy));
  return time;
}

TEST(Grippers, GraspedBodyMovesWithTheRobotUntilTheFingersOpen) {
  auto simulation = WithPosts(5s, {Post("post", 0.25, 0.01)});
  ASSERT_TRUE(simulation->AddRobot(RobotWithGripper("robot", 0, 0, Fetches({-0.3, 0.1, 0.8}))));
  const geometry::Pose start = PoseOf(*simulation, "post");
  RunTo(*simulation, 1s);
  EXPECT_EQ(HeldBy(*simulation, "robot"), "post");
  EXPECT_NEAR(simulation->Watch("robot", "gripper")->values[0], kWidth, 1e-9);
  const geometry::Pose robot_from_post =
      Inverse(PoseOf(*simulation, "robot")) * PoseOf(*simulation, "post");
  EXPECT_LT(Norm(PoseOf(*simulation, "post").position - start.position), 1e-4);
  for (const SimTime instant : {1500ms, 2000ms}) {
    RunTo(*simulation, instant);
    const geometry::Pose expected = PoseOf(*simulation, "robot") * robot_from_post;
    const geometry::Pose post = PoseOf(*simulation, "post");
    EXPECT_WITHIN(Norm(post.position - expected.position), 0, 1e-12, "m");
    EXPECT_NEAR(geometry::Yaw(post.orientation), geometry::Yaw(expected.orientation), 1e-12);
  }
  EXPECT_GT(Norm(PoseOf(*simulation, "post").position - start.position), 0.2);
  RunTo(*simulation, 3s);
  EXPECT_EQ(HeldBy(*simulation, "robot"), "");
  // The post was released while it moved, so it rocks from edge to edge before it stands still.
  const SimTime at_rest = 2s + base::FromSeconds(RockingTime());
  RunTo(*simulation, at_rest);
  const geometry::Pose left = PoseOf(*simulation, "post");
  RunTo(*simulation, at_rest + 500ms);  // meanwhile the robot drives away, and the post stays
  EXPECT_WITHIN(Norm(PoseOf(*simulation, "post").position - left.position), 0, 1e-5, "m");
  EXPECT_GT(Norm(PoseOf(*simulation, "robot").position - left.position), 0.3);
}

// The gripper is on a lift that rises at 0.5 m/s from 1 s to 2 s. Then it lets the post go.
TEST(Grippers, GraspedBodyHasTheVelocityOfTheGripper) {
  auto simulation = WithPosts(3s, {Post("post", 0.25, 0)});
  auto lifts = std::make_shared<ThreadBehaviour>([](Agent& agent, ClockId clock) {
    ASSERT_TRUE(agent.CommandDevice("gripper", {{0}, ""}));
    if (!SleepFor(agent, clock, 1s)) return;
    ASSERT_TRUE(agent.CommandJoint(0, {world::JointCommand::Kind::kVelocity, 0.5}));
    if (!SleepFor(agent, clock, 1s)) return;
    ASSERT_TRUE(agent.CommandDevice("gripper", {{1}, ""}));
    while (SleepFor(agent, clock, 1s)) {
    }
  });
  RobotSpecification robot = RobotWithGripper("robot", 0, 0, std::move(lifts));
  auto model = std::make_shared<model::Model>(*robot.model);
  model->links.push_back({});
  model::Joint lift;
  lift.name = "lift";
  lift.kind = model::JointKind::kPrismatic;
  lift.parent = 0;
  lift.child = 1;
  lift.axis = {0, 0, 1};
  lift.position_limits = {0, 2};
  model->joints.push_back(lift);
  model->sensors.back().link = 1;
  robot.model = model;
  ASSERT_TRUE(simulation->AddRobot(robot));
  const auto velocity = [&] {
    const auto snapshot = simulation->snapshot();
    return snapshot->state.bodies[static_cast<std::size_t>(snapshot->layout->Find("post"))]
        .linear_velocity.z;
  };
  RunTo(*simulation, 1500ms);
  ASSERT_EQ(HeldBy(*simulation, "robot"), "post");
  EXPECT_WITHIN(velocity(), 0.5, 1e-9, "m/s");
  const double height = PoseOf(*simulation, "post").position.z;
  RunTo(*simulation, 2s);
  EXPECT_WITHIN(PoseOf(*simulation, "post").position.z - height, 0.25, 1e-9, "m");
  RunTo(*simulation, 2100ms);
  EXPECT_WITHIN(velocity(), 0.5 - 9.8 * 0.1, 0.11, "m/s");
}

TEST(Grippers, CloseWithoutGraspingIfThereIsNoDynamicBody) {
  auto simulation = WithPosts(0s, {Post("post", -1, 0)});
  ASSERT_TRUE(simulation->AddRobot(RobotWithGripper("at_wall", 2.65, 0, Fetches({}, false))));
  ASSERT_TRUE(simulation->AddRobot(RobotWithGripper("robots", 0, 2, Fetches({}, false))));
  ASSERT_TRUE(simulation->AddRobot(Robot("other", 0.41, 2.2)));
  RunTo(*simulation, 200ms);
  // the opening has decreased from 0.1 m to 0.06 m
  EXPECT_NEAR(simulation->Watch("at_wall", "gripper")->values[0], 0.06, 1e-9);
  RunTo(*simulation, 1s);
  for (const char* name : {"at_wall", "robots"}) {
    EXPECT_EQ(HeldBy(*simulation, name), "") << name;
    EXPECT_EQ(simulation->Watch(name, "gripper")->values[0], 0) << name;
  }
}

TEST(Grippers, WallStopsAGraspedBody) {
  auto simulation = WithPosts(4s, {Post("post", 2.25, 0)});
  ASSERT_TRUE(simulation->AddRobot(RobotWithGripper("robot", 2, 0, Fetches({1, 0, 0}, false))));
  RunTo(*simulation, 1900ms);
  EXPECT_EQ(HeldBy(*simulation, "robot"), "post");
  // The wall's face is at x = 2.9.
  EXPECT_WITHIN(PoseOf(*simulation, "post").position.x + kWidth / 2, 2.9, 1e-4, "m");
}

TEST(Grippers, RigidRobotCanGrasp) {
  auto simulation = WithPosts(4s, {Post("post", 0.25, 0)});
  RobotSpecification robot = RobotWithGripper("robot", 0, 0, Fetches({-0.3, 0, 0.4}));
  robot.movement = model::Movement::kRigid;
  ASSERT_TRUE(simulation->AddRobot(robot));
  RunTo(*simulation, 1s);
  ASSERT_EQ(HeldBy(*simulation, "robot"), "post");
  const auto robot_from_post = Inverse(PoseOf(*simulation, "robot")) * PoseOf(*simulation, "post");
  const geometry::Pose start = PoseOf(*simulation, "post");
  RunTo(*simulation, 2s);
  const geometry::Pose expected = PoseOf(*simulation, "robot") * robot_from_post;
  EXPECT_LT(Norm(PoseOf(*simulation, "post").position - expected.position), 1e-12);
  EXPECT_GT(Norm(PoseOf(*simulation, "post").position - start.position), 0.15);
  RunTo(*simulation, 3s);
  EXPECT_EQ(HeldBy(*simulation, "robot"), "");
}

TEST(Grippers, FirstByNameOfTwoGrippersGraspsTheBody) {
  auto simulation = WithPosts(3s, {Post("post", 0.25, 0)});
  ASSERT_TRUE(
      simulation->AddRobot(RobotWithGripper("b", 0.5, 0, Fetches({}, false), std::numbers::pi)));
  ASSERT_TRUE(simulation->AddRobot(RobotWithGripper("a", 0, 0, Fetches({}, false))));
  RunTo(*simulation, 1s);
  EXPECT_EQ(HeldBy(*simulation, "a"), "post");
  EXPECT_EQ(HeldBy(*simulation, "b"), "");
}

TEST(Grippers, HashDoesNotDependOnTheSpeedOfBehaviours) {
  const auto hash_of = [](std::chrono::microseconds first, std::chrono::microseconds second) {
    auto simulation = WithPosts(4s, {Post("one", 0.25, 0), Post("two", 0.25, 1)});
    EXPECT_TRUE(
        simulation->AddRobot(RobotWithGripper("a", 0, 0, Fetches({-0.2, 0, 0.3}, true, first))));
    EXPECT_TRUE(
        simulation->AddRobot(RobotWithGripper("b", 0, 1, Fetches({-0.3, 0, 0}, true, second))));
    EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
    return simulation->state_hash();
  };
  const std::string hash = hash_of(0us, 0us);
  EXPECT_EQ(hash_of(0us, 5000us), hash);
  EXPECT_EQ(hash_of(5000us, 0us), hash);
}

TEST(Grippers, AGraspedBodyMovesWithAPlacedRobotAndIsReleasedWhenItIsPlaced) {
  auto simulation = WithPosts(0s, {Post("post", 0.25, 0)});
  ASSERT_TRUE(simulation->AddRobot(RobotWithGripper("robot", 0, 0, Fetches({}, false))));
  RunTo(*simulation, 1s);
  const auto robot_from_post = Inverse(PoseOf(*simulation, "robot")) * PoseOf(*simulation, "post");
  ASSERT_TRUE(simulation->PlaceBody("robot", PlanarPose(-1, 2, 0, 1), true));
  const auto expected = PoseOf(*simulation, "robot") * robot_from_post;
  EXPECT_LT(Norm(PoseOf(*simulation, "post").position - expected.position), 1e-9);
  EXPECT_EQ(HeldBy(*simulation, "robot"), "post");
  ASSERT_TRUE(simulation->PlaceBody("post", PlanarPose(1, -2, 0.1, 0), true));
  EXPECT_EQ(HeldBy(*simulation, "robot"), "");
  RunTo(*simulation, 1500ms);
  EXPECT_NEAR(PoseOf(*simulation, "post").position.x, 1, 1e-3);
}

TEST(Grippers, ReleaseTheBodyOnRemovalAndOnReset) {
  auto simulation = WithPosts(0s, {Post("post", 0.25, 0)});
  ASSERT_TRUE(simulation->AddRobot(RobotWithGripper("robot", 0, 0, Fetches({-0.2, 0, 0}, false))));
  const geometry::Pose start = PoseOf(*simulation, "post");
  RunTo(*simulation, 1500ms);
  EXPECT_EQ(HeldBy(*simulation, "robot"), "post");
  ASSERT_TRUE(simulation->Reset());
  EXPECT_EQ(HeldBy(*simulation, "robot"), "");
  EXPECT_EQ(PoseOf(*simulation, "post").position, start.position);
  RunTo(*simulation, 1500ms);
  EXPECT_EQ(HeldBy(*simulation, "robot"), "post");
  ASSERT_TRUE(simulation->RemoveRobot("robot"));
  EXPECT_TRUE(simulation->snapshot()->state.devices->empty());
  // The post is released at 0.2 m/s. It rocks and stops within half of its width. If the robot
  // still carried the post, the post would move by 0.1 m. If the post were fixed in place, it would
  // not move.
  const geometry::Pose left = PoseOf(*simulation, "post");
  RunTo(*simulation, 2s);
  const double moved = Norm(PoseOf(*simulation, "post").position - left.position);
  EXPECT_LT(moved, kWidth / 2);
  EXPECT_GT(moved, 1e-4);
}

}  // namespace
}  // namespace gsv::simulation
