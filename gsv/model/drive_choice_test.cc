#include "gsv/model/drive_choice.h"

#include <gmock/gmock.h>

#include <numbers>

namespace gsv::model {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A model with two wheels of radius 0.1 m, 0.4 m apart, and a wheel of radius 0.08 m behind them.
std::shared_ptr<Model> TwoWheels() {
  auto model = std::make_shared<Model>();
  model->name = "cart";
  model->links.push_back({.name = "base"});
  const geometry::Quaternion left = geometry::FromAxisAngle({1, 0, 0}, -std::numbers::pi / 2);
  for (const auto& [name, y] : {std::pair{"left", 0.2}, {"right", -0.2}}) {
    Link link{.name = name, .model_from_link = {{0, y, 0.1}, left}};
    link.collisions.push_back({"c", {}, geometry::Cylinder{0.1, 0.05}, {}});
    Joint joint;
    joint.name = std::string(name) + "_wheel";
    joint.kind = JointKind::kContinuous;
    joint.parent = 0;
    joint.child = static_cast<int>(model->links.size());
    joint.model_from_joint = link.model_from_link;
    model->links.push_back(link);
    model->joints.push_back(joint);
  }
  return model;
}

std::string RefusalOf(const std::string& text) {
  const auto choice = ParseDriveChoice(text);
  return choice ? "" : choice.error().Sentence();
}

TEST(DriveChoice, ParsesKindsJointsAndNumbers) {
  const auto choice = ParseDriveChoice("skid,left=fl,left=rl,right=fr,radius=0.165,separation=0.6");
  ASSERT_TRUE(choice);
  EXPECT_EQ(choice->kind, DriveKind::kDifferential);
  EXPECT_THAT(choice->left, ElementsAre("fl", "rl"));
  EXPECT_THAT(choice->right, ElementsAre("fr"));
  EXPECT_EQ(choice->radius, 0.165);
  EXPECT_EQ(choice->separation, 0.6);
  EXPECT_FALSE(choice->wheel_base);
}

TEST(DriveChoice, RejectsUnknownKeysAndKinds) {
  EXPECT_THAT(RefusalOf("hover"), HasSubstr("there is no drive \"hover\"; expected KIND"));
  EXPECT_THAT(RefusalOf(""), HasSubstr("there is no drive \"\""));
  EXPECT_THAT(RefusalOf("diff,radius=0"), HasSubstr("radius must be a number above zero"));
  EXPECT_THAT(RefusalOf("diff,radius=1e400"), HasSubstr("radius must be a number above zero"));
  EXPECT_THAT(RefusalOf("diff,colour=red"), HasSubstr("there is no key \"colour\""));
  EXPECT_THAT(RefusalOf("diff,left"), HasSubstr("\"left\" is not KEY=VALUE"));
}

TEST(AsRobot, MeasuresTheSizesThatAChoiceOmits) {
  const auto robot = AsRobot(TwoWheels(), "diff,left=right_wheel,right=left_wheel,radius=0.2");
  ASSERT_TRUE(robot);
  const Drive& drive = *(*robot)->drive;
  EXPECT_THAT(drive.left_wheels, ElementsAre(1));
  EXPECT_EQ(drive.wheel_radius, 0.2);
  EXPECT_NEAR(drive.wheel_separation, 0.4, 1e-12);
  EXPECT_EQ(drive.origin, DriveOrigin::kChosen);
  EXPECT_EQ(drive.choice, "diff,left=right_wheel,right=left_wheel,radius=0.2");
}

TEST(AsRobot, ChoiceOverridesTheModelsDrive) {
  const auto model = TwoWheels();
  model->drive.emplace();
  model->drive->left_wheels = {0};
  model->drive->right_wheels = {1};
  model->drive->linear_velocity = {-1, 1};
  EXPECT_EQ(AsRobot(model, "").value(), model);
  const auto robot = AsRobot(model, "diff,separation=0.5");
  ASSERT_TRUE(robot);
  EXPECT_EQ((*robot)->drive->wheel_separation, 0.5);
  EXPECT_EQ((*robot)->drive->linear_velocity.max, 1);
  EXPECT_EQ(AsRobot(model, "none").value()->drive->kind, DriveKind::kNone);
}

TEST(AsRobot, ListsTheJointsIfOneIsMissing) {
  const auto robot = AsRobot(TwoWheels(), "diff,left=port");
  ASSERT_FALSE(robot);
  EXPECT_THAT(robot.error().message,
              HasSubstr("no movable joint \"port\"; it has left_wheel, right_wheel"));
}

TEST(AsRobot, RejectsAModelWithoutJointsAndSensors) {
  const auto arm = TwoWheels();
  for (Joint& joint : arm->joints) joint.kind = JointKind::kRevolute;
  for (Joint& joint : arm->joints) joint.position_limits = {-1, 1};
  EXPECT_EQ(AsRobot(arm, "").value()->drive->kind, DriveKind::kNone);
  const auto chair = std::make_shared<Model>();
  chair->name = "chair";
  chair->links.emplace_back();
  const auto refused = AsRobot(chair, "");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("neither a drive nor wheels, movable joints"));
}

TEST(DescribeDrive, ContainsKindWheelsAndSizes) {
  EXPECT_EQ(DescribeDrive(*AsRobot(TwoWheels(), "").value()),
            "differential, guessed from wheels left_wheel, right_wheel; radius 0.1 m, separation "
            "0.4 m");
}

}  // namespace
}  // namespace gsv::model
