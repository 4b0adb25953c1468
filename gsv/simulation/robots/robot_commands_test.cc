#include "gsv/simulation/robots/robot_commands.h"

#include <gtest/gtest.h>

#include "gsv/sensing/testing/test_sensor.h"

namespace gsv::simulation {
namespace {

using Kind = DeviceAction::Kind;

MountedSensor Mounted(const std::string& type) {
  auto design = MakeSensorDesign(sensing::testing::DescriptionOf(type),
                                 sensing::testing::BuiltInSensors(), "robot/front");
  EXPECT_TRUE(design);
  return MountedSensor(*design);
}

DeviceAction Shines(const MountedSensor& lamp, double brightness) {
  auto action = CommandOf(lamp, {{brightness, 1, 1, 1}, ""}, "robot");
  EXPECT_TRUE(action);
  return *action;
}

std::vector<Kind> KindsOf(RobotCommands& commands) {
  std::vector<Kind> kinds;
  for (const DeviceAction& action : commands.devices()) kinds.push_back(action.kind);
  return kinds;
}

TEST(RobotCommands, AreEmptyAfterTheyWereTaken) {
  RobotCommands commands;
  EXPECT_TRUE(commands.empty());
  commands.SetDrive({0, {1, 0, 0}});
  commands.CommandJoint(2, {world::JointCommand::Kind::kVelocity, 3});
  RobotCommands taken = commands.Take();
  EXPECT_TRUE(commands.empty());
  EXPECT_EQ(taken.drive()->command.linear, 1);
  EXPECT_EQ(taken.joints().size(), 1u);
}

TEST(RobotCommands, OfferedDriveOfAnEarlierClockIsIgnored) {
  RobotCommands commands;
  commands.OfferDrive({2, {1, 0, 0}});
  commands.OfferDrive({1, {5, 0, 0}});
  EXPECT_EQ(commands.drive()->command.linear, 1);
  commands.OfferDrive({2, {3, 0, 0}});
  EXPECT_EQ(commands.drive()->command.linear, 3);
}

TEST(RobotCommands, MergedCommandsComeLast) {
  RobotCommands commands, later;
  commands.SetDrive({2, {1, 0, 0}});
  commands.CommandJoint(0, {world::JointCommand::Kind::kVelocity, 1});
  later.SetDrive({0, {4, 0, 0}});
  later.CommandJoint(0, {world::JointCommand::Kind::kVelocity, 2});
  commands.Merge(later.Take());
  EXPECT_EQ(commands.drive()->command.linear, 4);
  ASSERT_EQ(commands.joints().size(), 2u);
  EXPECT_EQ(commands.joints().back().second.value, 2);
  commands.Merge({});
  EXPECT_EQ(commands.drive()->command.linear, 4);
}

TEST(RobotCommands, LastCommandOfAnActuatorApplies) {
  const MountedSensor lamp = Mounted("lamp");
  RobotCommands commands, later;
  commands.Add(Shines(lamp, 0.25));
  later.Add(Shines(lamp, 0.5));
  commands.Merge(later.Take());
  ASSERT_EQ(commands.devices().size(), 1u);
  EXPECT_EQ(commands.devices().front().command.values[0], 0.5);
}

TEST(RobotCommands, DeviceThatIsRemovedAndCreatedAgainStartsFresh) {
  const MountedSensor lamp = Mounted("lamp");
  RobotCommands commands;
  commands.Add(Shines(lamp, 0.25));
  commands.Add({Kind::kSwitchOff, lamp.device()});
  EXPECT_EQ(KindsOf(commands), std::vector{Kind::kSwitchOff});
  commands.Add(Shines(lamp, 0.5));
  commands.Add(Shines(lamp, 0.75));
  EXPECT_EQ(KindsOf(commands), (std::vector{Kind::kSwitchOff, Kind::kCommand}));
  EXPECT_EQ(commands.devices().back().command.values[0], 0.75);
}

TEST(RobotCommands, MessagesAreAllKept) {
  const MountedSensor radio = Mounted("radio");
  RobotCommands commands;
  for (int i = 0; i < 2; ++i) commands.Add({Kind::kSwitchOn, radio.device()});
  for (int i = 0; i < 64; ++i) ASSERT_TRUE(commands.Send(radio, "", "hello", "robot"));
  EXPECT_FALSE(commands.Send(radio, "", "one too many", "robot"));
  commands.Add({Kind::kSwitchOff, radio.device()});
  EXPECT_EQ(commands.devices().size(), 65u);
  EXPECT_EQ(commands.devices().back().kind, Kind::kSwitchOff);
}

TEST(RobotCommands, AreRefusedForTheWrongSensor) {
  EXPECT_EQ(CommandOf(Mounted("sonar"), {}, "robot").error().Sentence(),
            "robot/front: a sensor accepts no commands");
  EXPECT_EQ(CommandOf(Mounted("radio"), {}, "robot").error().Sentence(),
            "robot/front: a sensor accepts no commands");
  RobotCommands commands;
  EXPECT_EQ(commands.Send(Mounted("lamp"), "", "x", "robot").error().Sentence(),
            "robot/front: cannot send a message: only a radio can");
  EXPECT_TRUE(commands.empty());
}

}  // namespace
}  // namespace gsv::simulation
