#include "gsv/ros2/options.h"

#include <gtest/gtest.h>

namespace gsv::ros2 {
namespace {

Environment Of(std::map<std::string, std::string> values) {
  return [values = std::move(values)](const char* name) {
    const auto found = values.find(name);
    return found == values.end() ? std::string() : found->second;
  };
}

TEST(Ros2Options, DefaultToThisMachineOnly) {
  const auto participant = ParticipantFor({}, Of({}));
  ASSERT_TRUE(participant);
  EXPECT_EQ(participant->range, dds::Range::kLocalhost);
  EXPECT_EQ(participant->domain, 0u);
  EXPECT_FALSE(IsExposed(*participant));
}

TEST(Ros2Options, ReadDomainRangeAndPeersFromTheEnvironment) {
  const auto subnet = ParticipantFor({}, Of({{"ROS_DOMAIN_ID", "42"},
                                             {"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"},
                                             {"ROS_STATIC_PEERS", "10.0.0.2;robot.local"}}));
  ASSERT_TRUE(subnet);
  EXPECT_EQ(subnet->domain, 42u);
  EXPECT_EQ(subnet->range, dds::Range::kSubnet);
  EXPECT_EQ(subnet->peers, (std::vector<std::string>{"10.0.0.2", "robot.local"}));
  const auto peers = ParticipantFor({}, Of({{"ROS_STATIC_PEERS", "127.0.0.1;10.0.0.2"}}));
  ASSERT_TRUE(peers);
  EXPECT_EQ(peers->range, dds::Range::kPeers);
  EXPECT_EQ(peers->peers, std::vector<std::string>{"10.0.0.2"});
}

TEST(Ros2Options, StayOnThisMachineWithLocalhostOnly) {
  const auto participant = ParticipantFor({}, Of({{"ROS_LOCALHOST_ONLY", "1"},
                                                  {"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"},
                                                  {"ROS_STATIC_PEERS", "10.0.0.2"}}));
  ASSERT_TRUE(participant);
  EXPECT_FALSE(IsExposed(*participant));
  EXPECT_TRUE(participant->peers.empty());
}

TEST(Ros2Options, OverrideTheEnvironment) {
  const auto participant = ParticipantFor(
      {.range = dds::Range::kLocalhost},
      Of({{"ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET"}, {"ROS_STATIC_PEERS", "10.0.0.2"}}));
  ASSERT_TRUE(participant);
  EXPECT_FALSE(IsExposed(*participant));
  EXPECT_TRUE(participant->peers.empty());
}

TEST(Ros2Options, RejectInvalidValuesWithAReason) {
  const std::map<std::string, std::string> bad[] = {{{"ROS_DOMAIN_ID", "233"}},
                                                    {{"ROS_DOMAIN_ID", "-1"}},
                                                    {{"ROS_DOMAIN_ID", "1 "}},
                                                    {{"ROS_LOCALHOST_ONLY", "yes"}},
                                                    {{"ROS_AUTOMATIC_DISCOVERY_RANGE", "subnet"}},
                                                    {{"ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF"}}};
  for (const auto& values : bad) {
    const auto participant = ParticipantFor({}, Of(values));
    ASSERT_FALSE(participant) << values.begin()->second;
    EXPECT_EQ(participant.error().where, values.begin()->first);
  }
  std::map<std::string, std::string> namespaces;
  for (const char* text : {"pebble", "=/", "pebble=", "pebble=x", "pebble=/x/"}) {
    EXPECT_FALSE(ParseNamespace(text, namespaces)) << text;
  }
  EXPECT_TRUE(ParseNamespace("pebble=/", namespaces));
  EXPECT_EQ(namespaces.at("pebble"), "/");
}

}  // namespace
}  // namespace gsv::ros2
