#include "gsv/scenario/scenario.h"

#include <numbers>

#include <gtest/gtest.h>

namespace gsv::scenario {
namespace {

TEST(ParseRobot, ModelAloneHasNoStartPose) {
  const auto robot = ParseRobot("turtlebot3_burger");
  ASSERT_TRUE(robot);
  EXPECT_EQ(robot->model, "turtlebot3_burger");
  EXPECT_FALSE(robot->start);
}

TEST(ParseRobot, AcceptsMetresAndRadiansOrDegrees) {
  const auto radians = ParseRobot("models/burger@-2,-0.5,1.5");
  ASSERT_TRUE(radians && radians->start);
  EXPECT_EQ(radians->model, "models/burger");
  EXPECT_EQ(*radians->start, (Place{-2, -0.5, {}, 1.5}));
  EXPECT_NEAR(geometry::Yaw(radians->start->pose().orientation), 1.5, 1e-12);
  const auto degrees = ParseRobot("b@1,1,90deg");
  ASSERT_TRUE(degrees && degrees->start);
  EXPECT_NEAR(degrees->start->yaw, std::numbers::pi / 2, 1e-12);
}

TEST(ParseRobot, AtSignInAFolderNameDoesNotEndTheModel) {
  const auto robot = ParseRobot("/home/me@lab/burger@1,2");
  ASSERT_TRUE(robot && robot->start);
  EXPECT_EQ(robot->model, "/home/me@lab/burger");
}

TEST(ParseRobot, RejectsAnInvalidPoseWithTheExpectedForm) {
  for (const char* text :
       {"b@", "b@1", "b@1,2,3,4", "b@1,x", "b@1,nan", "b@1,2,3degrees", "@1,2", ""}) {
    const auto robot = ParseRobot(text);
    ASSERT_FALSE(robot) << text;
    EXPECT_EQ(robot.error().code, base::ErrorCode::kInvalidArgument);
    EXPECT_NE(robot.error().message.find("MODEL[@x,y[,yaw]]"), std::string::npos);
  }
}

TEST(ParsePedestrians, AcceptsACountAndARoute) {
  const auto group = ParsePedestrians("20@-4,0,1.5:4,-1e1");
  ASSERT_TRUE(group);
  EXPECT_EQ(group->count, 20);
  EXPECT_EQ(group->route, (std::vector<model::PedestrianGoal>{{-4, 0, 1.5}, {4, -10, 0}}));
}

TEST(ParsePedestrians, RejectsAnInvalidRouteWithTheExpectedForm) {
  for (const char* text : {"", "20", "20@", "0@1,2", "1.5@1,2", "20@1", "20@1,2,3,4",
                           "20@1,2:", "20@1,2,-1", "x@1,2", "200000@1,2"}) {
    const auto group = ParsePedestrians(text);
    ASSERT_FALSE(group) << text;
    EXPECT_NE(group.error().message.find("COUNT@x,y"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace gsv::scenario
