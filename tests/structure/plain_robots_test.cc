// Tests robots as they are in ROS packages, without any plugin. The drive of each follows from its
// wheels.
#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv {
namespace {

using namespace simulation;

const std::string kInertia =
    "<inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial>";

std::string Link(const std::string& name, const std::string& mass, const std::string& shape,
                 const std::string& origin = "0 0 0") {
  const std::string geometry = shape.empty()
                                   ? ""
                                   : "<collision><origin xyz='" + origin + "'/><geometry>" + shape +
                                         "</geometry></collision>";
  return "<link name='" + name + "'><inertial><mass value='" + mass + "'/>" + kInertia + geometry +
         "</link>";
}

std::string Joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& origin, const std::string& axis,
                  const std::string& more = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin " + origin + "/><axis xyz='" + axis + "'/>" +
         more + "</joint>";
}

// A wheel of radius 0.1 m. Its cylinder is horizontal, as most exporters write it.
std::string Wheel(const std::string& name, const std::string& parent, const std::string& xyz) {
  return Link(name, "1", "<cylinder radius='0.1' length='0.05'/>") +
         Joint(name + "_joint", "continuous", parent, name, "xyz='" + xyz + "' rpy='-1.5708 0 0'",
               "0 0 1");
}

std::string Urdf(const std::string& content) {
  return "<?xml version='1.0'?><robot name='robot'>" + content + "</robot>";
}

// A robot like TurtleBot, with two wheels and a sliding ball.
std::string TwoWheelsAndABall() {
  return Urdf(Link("base", "5", "<box size='0.3 0.25 0.1'/>") + Wheel("left", "base", "0 0.16 0") +
              Wheel("right", "base", "0 -0.16 0") + Link("ball", "0.1", "<sphere radius='0.04'/>") +
              Joint("ball_joint", "fixed", "base", "ball", "xyz='-0.12 0 -0.06'", "0 0 1"));
}

// A robot like Husky, with four fixed wheels.
std::string FourWheels() {
  std::string wheels;
  for (const char* x : {"0.25", "-0.25"}) {
    for (const char* y : {"0.28", "-0.28"}) {
      const std::string name =
          std::string(*x == '-' ? "rear" : "front") + (*y == '-' ? "_right_wheel" : "_left_wheel");
      wheels += Wheel(name, "base", std::string(x) + " " + y + " 0");
    }
  }
  return Urdf(Link("base", "20", "<box size='0.8 0.4 0.15'/>") + wheels);
}

// A robot like the racecars of MIT and F1TENTH, with two steered wheels in front.
std::string Racecar() {
  std::string front;
  for (const char* y : {"0.12", "-0.12"}) {
    const std::string side = *y == '-' ? "right" : "left";
    front += Link(side + "_hinge", "0.1", "") +
             Joint(side + "_steering_joint", "revolute", "base", side + "_hinge",
                   "xyz='0.32 " + std::string(y) + " 0'", "0 0 1",
                   "<limit lower='-0.5' upper='0.5' effort='100' velocity='50'/>") +
             Wheel(side + "_front_wheel", side + "_hinge", "0 0 0");
  }
  return Urdf(Link("base", "5", "<box size='0.4 0.15 0.08'/>", "0.16 0 0") +
              Wheel("left_rear_wheel", "base", "0 0.12 0") +
              Wheel("right_rear_wheel", "base", "0 -0.12 0") + front);
}

// A robot like an industrial arm, which is fixed to the world.
std::string Arm() {
  const std::string limit = "<limit lower='-3' upper='3' effort='500' velocity='1'/>";
  return Urdf("<link name='world'/>" + Link("base", "5", "<cylinder radius='0.1' length='0.1'/>") +
              Joint("mount", "fixed", "world", "base", "xyz='0 0 0.05'", "0 0 1") +
              Link("upper", "2", "<cylinder radius='0.05' length='0.4'/>", "0 0 0.2") +
              Joint("shoulder", "revolute", "base", "upper", "xyz='0 0 0.05'", "0 1 0", limit) +
              Link("lower", "1", "<cylinder radius='0.04' length='0.3'/>", "0 0 0.15") +
              Joint("elbow", "revolute", "upper", "lower", "xyz='0 0 0.4'", "0 1 0", limit));
}

class PlainRobotsTest : public testing::TestWithParam<model::Movement> {
 protected:
  std::shared_ptr<const model::Model> Read(const std::string& urdf) {
    base::Problems problems;
    const auto model = library_.ReadModel(folder_.Write("robot.urdf", urdf).string(), problems);
    EXPECT_TRUE(model) << model.error().Sentence();
    for (const auto& problem : problems) ADD_FAILURE() << problem.Sentence();
    return model ? *model : nullptr;
  }

  // Returns the pose of the robot after two seconds of this command.
  geometry::Pose After2s(const std::string& urdf, const world::DriveCommand& command,
                         const std::string& drive = {}) {
    Specification specification = Lockstep(2s);
    auto world = std::make_shared<model::WorldDescription>(*specification.world);
    auto ground = std::make_shared<model::Model>();
    ground->name = "ground";
    ground->links.resize(1);
    ground->links[0].collisions.push_back({"plane", {}, geometry::Plane{}, {}});
    world->models = {{"ground", ground, {}, true}};
    specification.world = world;
    auto simulation = Make(std::move(specification));
    RobotSpecification robot;
    robot.name = "robot";
    robot.model = Read(urdf);
    robot.movement = GetParam();
    robot.drive = drive;
    robot.behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
      do {
        (void)agent.Command(command);
      } while (SleepFor(agent, clock, 100ms));
    });
    const auto added = simulation->AddRobot(std::move(robot));
    EXPECT_TRUE(added) << added.error().Sentence();
    EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
    return PoseOf(*simulation, "robot");
  }

  bool is_planar() const { return GetParam() == model::Movement::kPlanar; }

  base::testing::TestFolder folder_;
  formats::ModelLibrary library_;
};

// The robot drives at 0.5 m/s for 2 s. With rigid-body dynamics the wheels need time to accelerate,
// so 36 mm are missing.
TEST_P(PlainRobotsTest, DriveTheCommandedDistance) {
  const double tolerance = is_planar() ? 1e-9 : 0.04;
  for (const std::string& urdf : {TwoWheelsAndABall(), FourWheels(), Racecar()}) {
    const geometry::Pose pose = After2s(urdf, {0.5, 0, 0});
    EXPECT_NEAR(pose.position.x, 1, tolerance) << urdf.substr(0, 200);
    EXPECT_NEAR(pose.position.y, 0, 0.02);
  }
}

TEST_P(PlainRobotsTest, TurnOnTheSpotOrAlongAnArc) {
  const geometry::Pose two = After2s(TwoWheelsAndABall(), {0, 0, 0.5});
  EXPECT_NEAR(geometry::Yaw(two.orientation), 1, is_planar() ? 1e-9 : 0.05);
  // The origin of the car is the centre of its rear axle. The car follows an arc of radius v / ω
  // about a point on the line of this axle.
  const geometry::Pose car = After2s(Racecar(), {0.5, 0, 0.25});
  const double yaw = is_planar() ? 0.5 : geometry::Yaw(car.orientation);
  EXPECT_NEAR(geometry::Yaw(car.orientation), 0.5, is_planar() ? 1e-9 : 0.06);
  EXPECT_NEAR(car.position.x, 2 * std::sin(yaw), is_planar() ? 1e-9 : 0.05);
}

TEST_P(PlainRobotsTest, StayStillWithoutADrive) {
  for (const std::string& urdf : {Arm(), TwoWheelsAndABall()}) {
    const geometry::Pose pose = After2s(urdf, {0.5, 0, 0.5}, "none");
    EXPECT_NEAR(pose.position.x, 0, 1e-3);
    EXPECT_NEAR(geometry::Yaw(pose.orientation), 0, 1e-3);
  }
}

TEST_P(PlainRobotsTest, JointsOfAnArmFollowCommands) {
  const auto arm = Read(Arm());
  ASSERT_FALSE(arm->drive);
  auto simulation = Make(Lockstep(2s));
  RobotSpecification robot;
  robot.name = "arm";
  robot.model = arm;
  robot.movement = GetParam();
  double reached = 0;
  const int elbow = model::FindJoint(arm->joints, "elbow");
  robot.behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    EXPECT_TRUE(agent.CommandJoint(elbow, {world::JointCommand::Kind::kPosition, 0.8}));
    if (!SleepFor(agent, clock, 1900ms)) return;
    if (const auto reading = agent.ReadJoint(elbow)) reached = reading->position;
  });
  const auto added = simulation->AddRobot(std::move(robot));
  ASSERT_TRUE(added) << added.error().Sentence();
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_NEAR(reached, 0.8, is_planar() ? 1e-9 : 0.01);
}

TEST(PlainRobots, ModelWithoutJointsAndSensorsIsRejected) {
  auto simulation = Make(Lockstep(1s));
  auto chair = std::make_shared<model::Model>();
  chair->name = "chair";
  chair->links.resize(1);
  RobotSpecification robot;
  robot.name = "chair";
  robot.model = chair;
  const auto added = simulation->AddRobot(std::move(robot));
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().code, base::ErrorCode::kBadModel);
  EXPECT_THAT(added.error().message, testing::HasSubstr("neither a drive nor wheels"));
}

INSTANTIATE_TEST_SUITE_P(BothMovements, PlainRobotsTest,
                         testing::Values(model::Movement::kPlanar, model::Movement::kRigid),
                         [](const auto& parameter) {
                           return parameter.param == model::Movement::kPlanar ? "Planar" : "Rigid";
                         });

}  // namespace
}  // namespace gsv
