#include "apps/gsv/commands/robot_listing.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gsv::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// Makes robots cart_00, cart_01, …, which move.
class RobotListingTest : public ::testing::Test {
 protected:
  void Make(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      simulation::RobotStatus robot;
      robot.name = (i < 10 ? "cart_0" : "cart_") + std::to_string(i);
      robot.behaviour = "wander";
      robot.phase = simulation::AgentPhase::kWaiting;
      status_.robots.push_back(robot);
      healths_[robot.name] = {"moving", "has been moving for 9 s", 0, {}};
    }
  }
  std::string Listing(bool lists_all = false) const {
    return RobotListing(status_, healths_, lists_all);
  }

  simulation::SimulationStatus status_;
  std::map<std::string, RemoteHealth> healths_;
};

TEST_F(RobotListingTest, ListsFewRobotsByName) {
  Make(20);
  healths_["cart_19"] = {"dead", "has been dead for 2 s", 2, {}};
  const std::string text = Listing();
  EXPECT_THAT(text,
              StartsWith("  cart_00              wander           waiting; the robot has been"));
  EXPECT_THAT(text, HasSubstr("cart_19"));
  EXPECT_THAT(text, Not(HasSubstr("more")));
}

TEST_F(RobotListingTest, ListsTheWorstRobotsOfACrowdAndCountsTheOthers) {
  Make(50);
  healths_["cart_30"] = {"standing", "has not moved for 9 s", 0, {}};
  healths_["cart_31"] = {"contact", "has been in contact for 9 s", 1, {}};
  healths_["cart_32"] = {"stuck", "has been stuck for 9 s", 1, {}};
  healths_["cart_33"] = {"dead", "has been dead for 9 s", 2, {}};
  const std::string text = Listing();
  const auto place = [&](const char* name) { return text.find(name); };
  EXPECT_EQ(place("cart_33"), 2u);
  EXPECT_LT(place("cart_33"), place("cart_32"));
  EXPECT_LT(place("cart_32"), place("cart_31"));
  EXPECT_LT(place("cart_31"), place("cart_30"));
  EXPECT_LT(place("cart_30"), place("cart_00"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 21);
  EXPECT_THAT(text, HasSubstr("  and 30 more robots: 30 move (--all lists them)\n"));
}

TEST_F(RobotListingTest, ListsAllRobotsOfACrowdOnRequest) {
  Make(21);
  EXPECT_THAT(Listing(), HasSubstr("and 1 more robot: 1 moves (--all lists them)"));
  EXPECT_THAT(Listing(true), Not(HasSubstr("more")));
  EXPECT_THAT(Listing(true), HasSubstr("cart_20"));
}

TEST_F(RobotListingTest, ListsFailedBehavioursFirstWithoutHealth) {
  Make(30);
  healths_.clear();
  status_.robots[25].phase = simulation::AgentPhase::kDead;
  status_.robots[25].detail = "its process has ended";
  const std::string text = Listing();
  EXPECT_THAT(text, StartsWith("  cart_25              wander           dead: its process has"));
  EXPECT_THAT(text, HasSubstr("  and 10 more robots (--all lists them)\n"));
}

}  // namespace
}  // namespace gsv::app
