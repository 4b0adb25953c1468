// Tests pedestrians in a world: alone, in pairs, among walls and robots, in a crowd.
#include "gsv/dynamics/people/crowd.h"

#include <gtest/gtest.h>

#include "gsv/base/random.h"
#include "gsv/base/thread_team.h"
#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using geometry::PlanarPose;
using testing::TestWorld;

constexpr double kCrowdStep = 0.02, kTurned = 3.14159265358979323846;

std::shared_ptr<const model::PedestrianGroup> GroupTo(std::vector<model::PedestrianGoal> route) {
  auto group = std::make_shared<model::PedestrianGroup>();
  group->route = std::move(route);
  return group;
}

// A pedestrian that walks from the first goal of the route to the second.
void AddPedestrian(TestWorld& world, const std::string& name,
                   const std::shared_ptr<const model::PedestrianGroup>& group,
                   const geometry::Pose& start, double speed = 1.34) {
  world::Pedestrian pedestrian;
  pedestrian.group = group;
  pedestrian.speed = speed;
  pedestrian.stream = base::StableId(name);
  world.AddPedestrian(name, pedestrian, start);
}

TEST(Crowd, SinglePedestrianReachesItsDesiredSpeed) {
  TestWorld world(MakeWorldEngine());
  AddPedestrian(world, "ann", GroupTo({{0, 0}, {100, 0}}), {}, 1.2);
  ASSERT_TRUE(world.Start());
  for (int i = 1; i <= 200; ++i) {
    world.Step(kCrowdStep);
    EXPECT_NEAR(world.body("ann").linear_velocity.x, 1.2 * (1 - std::exp(-kCrowdStep * i / 0.5)),
                1e-9);
  }
  EXPECT_EQ(world.position("ann").y, 0);
}

TEST(Crowd, PedestrianFacesItsDirectionOfMotion) {
  TestWorld world(MakeWorldEngine());
  AddPedestrian(world, "ann", GroupTo({{0, 0}, {0, 100}}), {});
  ASSERT_TRUE(world.Start());
  world.Run(4, kCrowdStep);
  EXPECT_NEAR(world.yaw("ann"), kTurned / 2, 1e-3);
  EXPECT_NEAR(world.body("ann").linear_velocity.y, 1.34, 1e-3);
}

TEST(Crowd, TwoPedestriansPassSymmetrically) {
  TestWorld world(MakeWorldEngine());
  AddPedestrian(world, "ann", GroupTo({{0, 0}, {8, 0}}), PlanarPose(-8, -0.1, 0, 0));
  AddPedestrian(world, "bob", GroupTo({{0, 0}, {-8, 0}}), PlanarPose(8, 0.1, 0, kTurned));
  ASSERT_TRUE(world.Start());
  double closest = 100, side = 0;
  for (int i = 0; i < 500; ++i) {
    EXPECT_TRUE(world.Step(kCrowdStep).empty());
    const geometry::Vector3 &a = world.position("ann"), &b = world.position("bob");
    // The second pedestrian's path is the first pedestrian's path, rotated by 180 degrees about the
    // origin. The tolerance allows for rounding errors, which grow while the pedestrians avoid each
    // other.
    ASSERT_NEAR(a.x, -b.x, 1e-3);
    ASSERT_NEAR(a.y, -b.y, 1e-3);
    const double apart = std::hypot(a.x - b.x, a.y - b.y);
    if (apart < closest) side = a.y;
    closest = std::min(closest, apart);
  }
  EXPECT_LT(side, -0.2);  // each pedestrian keeps to its right
  EXPECT_GT(closest, 0.5);
  EXPECT_GT(world.position("ann").x, 4);
}

TEST(Crowd, PedestriansWalkFromGoalToGoal) {
  TestWorld world(MakeWorldEngine());
  AddPedestrian(world, "ann", GroupTo({{0, 0}, {4, 0}}), {});
  ASSERT_TRUE(world.Start());
  const int ann = world.layout().Find("ann");
  world.Run(2, kCrowdStep);
  EXPECT_EQ(world.state().goals[ann], 0u);
  world.Run(1, kCrowdStep);
  EXPECT_EQ(world.state().goals[ann], 1u);
  world.Run(4, kCrowdStep);
  EXPECT_EQ(world.state().goals[ann], 2u);
  EXPECT_LT(world.position("ann").x, 3);
}

TEST(Crowd, PedestrianWalksInTheMiddleOfACorridor) {
  TestWorld world(MakeWorldEngine());
  world.AddBox("left", {40, 0.2, 2}, 0, 1.1);
  world.AddBox("right", {40, 0.2, 2}, 0, -1.1);
  AddPedestrian(world, "ann", GroupTo({{0, 0}, {15, 0}}), PlanarPose(-10, 0.5, 0, 0));
  ASSERT_TRUE(world.Start());
  world.Run(10, kCrowdStep);
  EXPECT_NEAR(world.position("ann").y, 0, 0.02);
  EXPECT_GT(world.position("ann").x, 2);
}

TEST(Crowd, PedestriansAvoidARobotAndStopAFastRobot) {
  TestWorld world(MakeWorldEngine());
  world.AddRobot("robot", testing::DiscRobot(), PlanarPose(4, 0, 0, 0));
  AddPedestrian(world, "ann", GroupTo({{0, 0}, {9, 0}}), {});
  ASSERT_TRUE(world.Start());
  world.Run(8, kCrowdStep);
  EXPECT_GT(world.position("ann").x, 5.5);
  EXPECT_EQ(world.body("ann").collisions, 0u);
  TestWorld hall(MakeWorldEngine());
  hall.AddRobot("robot", testing::DiscRobot(), PlanarPose(2, 0, 0, kTurned));
  // The pedestrian wants to stay where it is, in a corner.
  hall.AddBox("west", {0.2, 4, 2}, -0.4, 0);
  hall.AddBox("north", {4, 0.2, 2}, 0, 0.4);
  hall.AddBox("south", {4, 0.2, 2}, 0, -0.4);
  AddPedestrian(hall, "ann", GroupTo({{0, 0}}), {});
  ASSERT_TRUE(hall.Start());
  hall.Command("robot", {1, 0, 0});
  hall.Run(4, kCrowdStep);
  EXPECT_GE(hall.body("robot").collisions, 1u);
  EXPECT_GE(std::hypot(hall.position("robot").x - hall.position("ann").x,
                       hall.position("robot").y - hall.position("ann").y),
            0.45 - 1e-5);
}

TestWorld Square(int people, int threads) {
  TestWorld world(MakeWorldEngine(std::make_shared<base::ThreadTeam>(threads)));
  const auto group = GroupTo({{-10, -10, 4}, {10, 10, 4}, {-10, 10, 4}, {10, -10, 4}});
  world.AddBox("pillar", {2, 2, 2}, 0, 0);
  world.AddRobot("robot", testing::DiscRobot(), PlanarPose(3, 3, 0, 0));
  const int columns = static_cast<int>(std::ceil(std::sqrt(people)));
  for (int i = 0; i < people; ++i) {
    const std::string name = "p" + std::to_string(i);
    const auto pedestrian = world::DrawPedestrian(group, 7, base::StableId(name));
    world.AddPedestrian(name, pedestrian,
                        PlanarPose((i % columns - columns / 2) * 1.2,
                                   (i / columns - columns / 2) * 1.2 + 0.6, 0, 0));
  }
  return world;
}

TEST(Crowd, IsRepeatableForAnyNumberOfThreads) {
  const auto digest = [](int threads) {
    TestWorld world = Square(300, threads);
    EXPECT_TRUE(world.Start());
    world.Command("robot", {0.5, 0, 0.2});
    world.Run(4, kCrowdStep);
    return world.Digest();
  };
  const std::uint64_t alone = digest(1);
  EXPECT_EQ(digest(1), alone);
  EXPECT_EQ(digest(3), alone);
}

TEST(Crowd, PedestriansNeverOverlap) {
  TestWorld world = Square(200, 1);
  ASSERT_TRUE(world.Start());
  for (int i = 0; i < 10; ++i) {
    world.Run(1, kCrowdStep);
    EXPECT_TRUE(world.engine().Overlaps(world.state(), 1e-5).empty());
  }
}

TEST(Crowd, IsAnObstacleForRigidBodies) {
  TestWorld world = testing::WorldOnGround();
  AddPedestrian(world, "ann", GroupTo({{0, 0}, {10, 0}}), {});
  world.AddRigid("ball", testing::SolidOf(geometry::Sphere{0.2}, 0.5), testing::At(4, 0, 0.2));
  ASSERT_TRUE(world.Start());
  world.Run(5, kCrowdStep);
  EXPECT_GT(world.position("ann").x, 3.5);
  EXPECT_GE(std::hypot(world.position("ann").x - world.position("ball").x,
                       world.position("ann").y - world.position("ball").y),
            0.4);
}

}  // namespace
}  // namespace gsv::dynamics
