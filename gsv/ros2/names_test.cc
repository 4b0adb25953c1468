#include "gsv/ros2/names.h"

#include <gtest/gtest.h>

#include "gsv/ros2/recording_bridge.h"

namespace gsv::ros2 {
namespace {

TEST(RosNames, AreEncodedAsInRos) {
  EXPECT_EQ(DdsTopicName("/pebble/scan"), "rt/pebble/scan");
  EXPECT_EQ(DdsTypeName("sensor_msgs/msg/LaserScan"), "sensor_msgs::msg::dds_::LaserScan_");
}

TEST(RosNames, AreDecodedFromDdsNames) {
  EXPECT_EQ(RosTopicName("rt/pebble/scan"), "/pebble/scan");
  EXPECT_EQ(RosTypeName("sensor_msgs::msg::dds_::LaserScan_"), "sensor_msgs/msg/LaserScan");
  EXPECT_EQ(RosTopicName("ros_discovery_info"), "");
  EXPECT_EQ(RosTypeName("LaserScan"), "");
}

TEST(RosNames, ReplaceCharactersThatRosDoesNotAllow) {
  EXPECT_EQ(RosName("pebble"), "pebble");
  EXPECT_EQ(RosName("box-1.a b"), "box_1_a_b");
  EXPECT_EQ(RosName("2nd"), "_2nd");
  EXPECT_EQ(RosName(""), "_");
}

TEST(RosNames, ValidateNamespaces) {
  for (const char* good : {"/", "/a", "/a/b_2", "/_"}) EXPECT_TRUE(IsNamespace(good)) << good;
  for (const char* bad : {"", "a", "/a/", "//", "/2", "/a-b", "/a//b"}) {
    EXPECT_FALSE(IsNamespace(bad)) << bad;
  }
}

TEST(RosNames, IncludeTheirNamespace) {
  EXPECT_EQ(InNamespace("/", "scan"), "/scan");
  EXPECT_EQ(InNamespace("/pebble", "scan"), "/pebble/scan");
}

TEST(RosNames, ReplaceInvalidNamesOfRecordedTopics) {
  EXPECT_EQ(PublishedTopic("/pebble/camera"), "/pebble/camera");
  EXPECT_EQ(PublishedTopic("tall one//2d/"), "/tall_one/_2d");
  EXPECT_EQ(PublishedTopic("//"), "");
}

}  // namespace
}  // namespace gsv::ros2
