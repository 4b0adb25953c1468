#include "gsv/ros2/topic_problems.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/ros2/names.h"

namespace gsv::ros2 {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kTwist = "geometry_msgs/msg/Twist";

dds::Endpoint EndpointOf(bool is_writer, const std::string& type, const dds::Qos& qos = {},
                         const std::string& user_data = "") {
  dds::Endpoint endpoint;
  endpoint.is_writer = is_writer;
  endpoint.topic = {"rt/topic", DdsTypeName(type), qos, user_data};
  return endpoint;
}

std::string HashOfDigits(char digit) { return "RIHS01_" + std::string(64, digit); }

TEST(TopicProblems, AreAbsentForEqualEndpoints) {
  const auto data = "typehash=" + HashOfDigits('a') + ";";
  EXPECT_THAT(
      FindTopicProblems({EndpointOf(true, kTwist, {}, data), EndpointOf(false, kTwist, {}, data),
                         EndpointOf(false, kTwist, {.is_reliable = false})}),
      IsEmpty());
  EXPECT_THAT(FindTopicProblems({}), IsEmpty());
}

TEST(TopicProblems, NameTypesThatDiffer) {
  EXPECT_THAT(FindTopicProblems(
                  {EndpointOf(true, "geometry_msgs/msg/TwistStamped"), EndpointOf(false, kTwist)}),
              ElementsAre(HasSubstr("/topic: a publisher has type geometry_msgs/msg/TwistStamped, "
                                    "a subscription geometry_msgs/msg/Twist")));
}

TEST(TopicProblems, ReportMismatchedTypeHashes) {
  EXPECT_THAT(
      FindTopicProblems({EndpointOf(true, kTwist, {}, "typehash=" + HashOfDigits('a') + ";"),
                         EndpointOf(false, kTwist, {}, "typehash=" + HashOfDigits('b') + ";")}),
      ElementsAre(HasSubstr(HashOfDigits('a') + " and " + HashOfDigits('b'))));
}

TEST(TopicProblems, NameQosThatIsNotOffered) {
  const dds::Qos best_effort{.is_reliable = false};
  const dds::Qos latched{.is_reliable = false, .is_transient_local = true};
  EXPECT_THAT(FindTopicProblems({EndpointOf(true, kTwist, best_effort), EndpointOf(false, kTwist),
                                 EndpointOf(false, kTwist)}),
              ElementsAre(HasSubstr("/topic: a subscription requires reliable delivery")));
  EXPECT_THAT(FindTopicProblems({EndpointOf(true, kTwist), EndpointOf(false, kTwist, latched)}),
              ElementsAre(HasSubstr("transient local durability")));
  EXPECT_THAT(FindTopicProblems(
                  {EndpointOf(true, kTwist, latched), EndpointOf(false, kTwist, best_effort)}),
              IsEmpty());
}

TEST(TopicProblems, IgnoreTopicsThatAreNotOfRos) {
  dds::Endpoint writer = EndpointOf(true, kTwist),
                reader = EndpointOf(false, "std_msgs/msg/String");
  writer.topic.name = reader.topic.name = "some_topic";
  EXPECT_THAT(FindTopicProblems({writer, reader}), IsEmpty());
}

}  // namespace
}  // namespace gsv::ros2
