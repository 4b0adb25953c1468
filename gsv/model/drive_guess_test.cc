// Guesses the drives of well-known kinds of robots. Their models are made of simple shapes.
#include "gsv/model/drive_guess.h"

#include <gmock/gmock.h>

#include <numbers>

#include "gsv/model/drive_choice.h"

namespace gsv::model {
namespace {

using geometry::Pose;
using geometry::Vector3;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr double kQuarter = std::numbers::pi / 2;
const geometry::Quaternion kAxisLeft = geometry::FromAxisAngle({1, 0, 0}, -kQuarter);

// A robot whose base is a box. Tests add wheels and other parts.
class Robot {
 public:
  Robot() {
    model_.name = "robot";
    Link base;
    base.name = "base";
    base.collisions.push_back({"c", {{0, 0, 0.25}, {}}, geometry::Box{{0.6, 0.3, 0.2}}, {}});
    model_.links.push_back(base);
  }

  int AddLink(const std::string& name, const Vector3& at, std::optional<geometry::Shape> shape) {
    Link link;
    link.name = name;
    link.model_from_link = {at, kAxisLeft};
    if (shape) link.collisions.push_back({"c", {}, *shape, {}});
    model_.links.push_back(link);
    return static_cast<int>(model_.links.size()) - 1;
  }

  int AddJoint(const std::string& name, int parent, int child, JointKind kind,
               const geometry::Quaternion& orientation) {
    Joint joint;
    joint.name = name;
    joint.parent = parent;
    joint.child = child;
    joint.kind = kind;
    joint.model_from_joint = {
        model_.links[static_cast<std::size_t>(child)].model_from_link.position, orientation};
    model_.joints.push_back(joint);
    return static_cast<int>(model_.joints.size()) - 1;
  }

  // A wheel that touches the ground at z = 0.
  int AddWheel(const std::string& name, double x, double y, double radius = 0.1, int parent = 0) {
    const int link =
        AddLink(name, {x, y, radius}, geometry::Shape(geometry::Cylinder{radius, 0.04}));
    return AddJoint(name + "_joint", parent, link, JointKind::kContinuous, kAxisLeft);
  }

  // Adds a link that rotates about the vertical, with a wheel on it.
  void AddSwivel(const std::string& name, double x, double y, double trail, Range range,
                 double radius = 0.1) {
    const int yoke = AddLink(name + "_yoke", {x + trail, y, radius}, std::nullopt);
    const int joint = AddJoint(name + "_swivel", 0, yoke, JointKind::kRevolute, {});
    model_.joints[static_cast<std::size_t>(joint)].position_limits = range;
    AddWheel(name, x, y, radius, yoke);
  }

  std::vector<std::string> Names(const std::vector<int>& joints) const {
    std::vector<std::string> names;
    for (const int joint : joints) names.push_back(model_.joints.at(joint).name);
    return names;
  }

  Model& model() { return model_; }
  Drive Guess() const { return GuessDrive(model_); }

 private:
  Model model_;
};

constexpr Range kEndless;
constexpr Range kSteering{-0.6, 0.6};

TEST(DriveGuess, TwoWheelsAndABallAreADifferentialDrive) {
  Robot robot;
  robot.AddWheel("left", 0, 0.2);
  robot.AddWheel("right", 0, -0.2);
  const int ball = robot.AddLink("ball", {-0.2, 0, 0.05}, geometry::Shape(geometry::Sphere{0.05}));
  robot.AddJoint("ball_joint", 0, ball, JointKind::kFixed, {});
  const Drive drive = robot.Guess();
  EXPECT_EQ(drive.kind, DriveKind::kDifferential);
  EXPECT_EQ(drive.origin, DriveOrigin::kGuessed);
  EXPECT_THAT(robot.Names(drive.left_wheels), ElementsAre("left_joint"));
  EXPECT_THAT(robot.Names(drive.right_wheels), ElementsAre("right_joint"));
  EXPECT_NEAR(drive.wheel_radius, 0.1, 1e-12);
  EXPECT_NEAR(drive.wheel_separation, 0.4, 1e-12);
}

TEST(DriveGuess, SidesFollowFromPositionsAndNotFromNames) {
  Robot robot;
  robot.AddWheel("right", 0, 0.2);
  robot.AddWheel("left", 0, -0.2);
  EXPECT_THAT(robot.Names(robot.Guess().left_wheels), ElementsAre("right_joint"));
}

TEST(DriveGuess, FourFixedWheelsAreASkidSteerDrive) {
  Robot robot;
  for (const double x : {0.2, -0.2}) {
    for (const double y : {0.25, -0.25}) {
      robot.AddWheel("wheel" + std::to_string(robot.model().joints.size()), x, y);
    }
  }
  const Drive drive = robot.Guess();
  EXPECT_EQ(drive.kind, DriveKind::kDifferential);
  EXPECT_THAT(drive.left_wheels, ElementsAre(0, 2));
  EXPECT_THAT(drive.right_wheels, ElementsAre(1, 3));
  EXPECT_NEAR(drive.wheel_separation, 0.5, 1e-12);
}

TEST(DriveGuess, CastersAndSmallerWheelsAreNotDriven) {
  Robot robot;
  robot.AddWheel("left", 0, 0.2);
  robot.AddWheel("right", 0, -0.2);
  for (const double x : {0.25, -0.25}) {
    for (const double y : {0.15, -0.15}) {
      robot.AddSwivel("c" + std::to_string(robot.model().joints.size()), x, y, 0.03, kEndless,
                      0.06);
    }
  }
  robot.AddWheel("idler_left", 0.3, 0.2, 0.05);
  robot.AddWheel("idler_right", 0.3, -0.2, 0.05);
  const Drive drive = robot.Guess();
  EXPECT_EQ(drive.kind, DriveKind::kDifferential);
  EXPECT_THAT(robot.Names(drive.left_wheels), ElementsAre("left_joint"));
  EXPECT_THAT(robot.Names(drive.right_wheels), ElementsAre("right_joint"));
  EXPECT_THAT(drive.steered, IsEmpty());
}

TEST(DriveGuess, CentreWheelsAndNamedCastersAreNotDriven) {
  Robot robot;
  robot.AddWheel("left", 0, 0.2);
  robot.AddWheel("right", 0, -0.2);
  robot.AddWheel("rear", -0.25, 0);
  robot.AddWheel("caster_front", 0.25, 0.2);
  const Drive drive = robot.Guess();
  EXPECT_THAT(robot.Names(drive.left_wheels), ElementsAre("left_joint"));
  EXPECT_THAT(robot.Names(drive.right_wheels), ElementsAre("right_joint"));
}

TEST(DriveGuess, SteeredFrontWheelsAreAckermannSteering) {
  Robot robot;
  robot.AddWheel("rear_left", -0.16, 0.1);
  robot.AddWheel("rear_right", -0.16, -0.1);
  robot.AddSwivel("front_left", 0.165, 0.1, 0, kSteering);
  robot.AddSwivel("front_right", 0.165, -0.1, 0, kSteering);
  const Drive drive = robot.Guess();
  EXPECT_EQ(drive.kind, DriveKind::kAckermann);
  EXPECT_THAT(robot.Names(drive.left_wheels), ElementsAre("rear_left_joint", "front_left_joint"));
  EXPECT_THAT(robot.Names(drive.steered),
              UnorderedElementsAre("front_left_swivel", "front_right_swivel"));
  EXPECT_NEAR(drive.wheel_base, 0.325, 1e-12);
  EXPECT_NEAR(drive.wheel_separation, 0.2, 1e-12);
  EXPECT_NEAR(drive.steering_limit, 0.6, 1e-12);
}

TEST(DriveGuess, OneSteeredFrontWheelIsATricycle) {
  Robot robot;
  robot.AddWheel("left", 0, 0.2);
  robot.AddWheel("right", 0, -0.2);
  robot.AddSwivel("front", 0.5, 0, 0, kSteering);
  const Drive drive = robot.Guess();
  EXPECT_EQ(drive.kind, DriveKind::kAckermann);
  EXPECT_THAT(robot.Names(drive.left_wheels), ElementsAre("left_joint"));
  EXPECT_NEAR(drive.wheel_base, 0.5, 1e-12);
}

TEST(DriveGuess, WheelsThatSteerInFrontAndBehindAreHeldStraight) {
  Robot robot;
  robot.AddWheel("left", 0, 0.3);
  robot.AddWheel("right", 0, -0.3);
  robot.AddSwivel("fl", 0.4, 0.3, 0, kSteering);
  robot.AddSwivel("rl", -0.4, 0.3, 0, kSteering);
  const Drive drive = robot.Guess();
  EXPECT_EQ(drive.kind, DriveKind::kDifferential);
  EXPECT_THAT(robot.Names(drive.steered), UnorderedElementsAre("fl_swivel", "rl_swivel"));
}

TEST(DriveGuess, FourFreelySteeredWheelsAreAnOmnidirectionalBase) {
  Robot robot;
  for (const double x : {0.22, -0.22}) {
    for (const double y : {0.22, -0.22}) {
      robot.AddSwivel("caster" + std::to_string(robot.model().joints.size()), x, y, 0, kEndless);
    }
  }
  EXPECT_EQ(robot.Guess().kind, DriveKind::kVelocity);
}

TEST(DriveGuess, MecanumWheelsAreFoundByTheirFrictionDirection) {
  Robot robot;
  for (const double x : {0.2, -0.2}) {
    for (const double y : {0.25, -0.25}) {
      robot.AddWheel("w" + std::to_string(robot.model().joints.size()), x, y);
      Surface& surface = robot.model().links.back().collisions.back().surface;
      surface.friction2 = 0;
      surface.friction_direction = geometry::Normalized(Vector3{1, 0, x * y > 0 ? 1.0 : -1.0});
    }
  }
  const Drive drive = robot.Guess();
  EXPECT_EQ(drive.kind, DriveKind::kMecanum);
  EXPECT_NEAR(drive.wheel_base, 0.4, 1e-12);
}

TEST(DriveGuess, WheelsWithACommandInterfaceArePreferred) {
  Robot robot;
  for (const double x : {0.2, -0.2}) {
    robot.AddWheel(x > 0 ? "fl" : "rl", x, 0.25);
    robot.AddWheel(x > 0 ? "fr" : "rr", x, -0.25);
  }
  robot.model().control_systems.push_back({"base",
                                           "system",
                                           "",
                                           {{"rl_joint", {"velocity"}, {}},
                                            {"rr_joint", {"velocity"}, {}},
                                            {"fl_joint", {}, {"position"}}}});
  const Drive drive = robot.Guess();
  EXPECT_THAT(robot.Names(drive.left_wheels), ElementsAre("rl_joint"));
  EXPECT_THAT(robot.Names(drive.right_wheels), ElementsAre("rr_joint"));
}

TEST(DriveGuess, WheelsMadeOfMeshesOrVisualsAreMeasured) {
  auto ring = std::make_shared<geometry::TriangleMesh>();
  for (int i = 0; i < 32; ++i) {
    const double angle = 2 * std::numbers::pi * i / 32;
    for (const double z : {-0.5, 0.5}) {
      ring->positions.push_back({3 * std::cos(angle), 3 * std::sin(angle), z});
    }
  }
  Robot robot;
  robot.AddWheel("left", 0, 0.2);
  robot.AddWheel("right", 0, -0.2);
  Link& left = robot.model().links[1];
  left.collisions.front().shape = geometry::Mesh{ring, {0.05, 0.05, 0.05}};
  Link& right = robot.model().links[2];
  Visual visual;
  visual.shape = geometry::Mesh{ring, {0.05, 0.05, 0.05}};
  right.visuals.push_back(visual);
  right.collisions.clear();
  const Drive drive = robot.Guess();
  EXPECT_EQ(drive.kind, DriveKind::kDifferential);
  EXPECT_NEAR(drive.wheel_radius, 0.15, 1e-9);
}

TEST(DriveGuess, ArmHasNoWheels) {
  Robot robot;
  int parent = 0;
  for (int i = 0; i < 6; ++i) {
    const int link = robot.AddLink("arm" + std::to_string(i), {0, 0, 0.5 + 0.2 * i},
                                   geometry::Shape(geometry::Cylinder{0.06, 0.1}));
    robot.AddJoint("j" + std::to_string(i), parent, link, JointKind::kContinuous,
                   i % 2 == 0 ? geometry::Quaternion{} : kAxisLeft);
    parent = link;
  }
  EXPECT_EQ(robot.Guess().kind, DriveKind::kNone);
}

TEST(DriveGuess, SquareAndOffAxisLinksAreNotWheels) {
  for (const bool is_square : {true, false}) {
    Robot robot;
    robot.AddWheel("left", 0, 0.2);
    robot.AddWheel("right", 0, -0.2);
    for (const int i : {1, 2}) {
      Collision& collision = robot.model().links[static_cast<std::size_t>(i)].collisions.front();
      if (is_square) {
        collision.shape = geometry::Box{{0.2, 0.2, 0.04}};
      } else {
        collision.link_from_collision.position.x = 0.05;
      }
    }
    EXPECT_EQ(robot.Guess().kind, DriveKind::kNone) << is_square;
  }
}

TEST(DriveGuess, LinkThatDoesNotTouchTheGroundIsNotAWheel) {
  Robot robot;
  robot.AddWheel("left", 0, 0.2);
  robot.AddWheel("right", 0, -0.2);
  robot.AddWheel("reel_left", 0.2, 0.2);
  robot.model().links.back().model_from_link.position.z = 0.5;
  robot.model().joints.back().model_from_joint.position.z = 0.5;
  EXPECT_THAT(robot.Names(robot.Guess().left_wheels), ElementsAre("left_joint"));
}

}  // namespace
}  // namespace gsv::model
