// Compares computed hashes with the hashes that packages of ROS 2 Jazzy and simulation_interfaces
// 2.0 publish.
#include "gsv/ros2/types/type_hash.h"

#include <gtest/gtest.h>

#include "gsv/ros2/types/service_names.h"

namespace gsv::ros2 {
namespace {

TEST(TypeHash, MessagesHaveTheHashThatRosPublishes) {
  const std::pair<const char*, const char*> kPublished[] = {
      {"std_msgs/msg/String",
       "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"},
      {"sensor_msgs/msg/LaserScan",
       "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828"},
      {"geometry_msgs/msg/Twist",
       "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"},
      {"builtin_interfaces/msg/Time",
       "RIHS01_b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197"},
      {"std_msgs/msg/Header",
       "RIHS01_f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01"},
      {"geometry_msgs/msg/PoseStamped",
       "RIHS01_10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8"},
      {"simulation_interfaces/msg/Resource",
       "RIHS01_2bb1939cf80f8d2f284afba53cbec60b5ff33759bd39b714128ea8867a34c51a"},
      {"simulation_interfaces/msg/Result",
       "RIHS01_cf43a306adff3337a0a47143d8f5689933bc70a30478f13b077dc1fe3bc5ad17"},
      {"simulation_interfaces/msg/SimulatorFeatures",
       "RIHS01_8b101c8529bc0ea3dcf056078254768f39832b9ef0adaf93bd5cea96c0de3305"},
      // Tests a field that is a fixed array of char.
      {"service_msgs/msg/ServiceEventInfo",
       "RIHS01_41bcbbe07a75c9b52bc96bfd5c24d7f0fc0a08c0cb7921b3373c5732345a6f45"},
  };
  for (const auto& [type, hash] : kPublished) EXPECT_EQ(TypeHashOf(type), hash) << type;
}

TEST(TypeHash, ServicesHaveTheHashThatRosPublishes) {
  const std::pair<const char*, const char*> kPublished[] = {
      {"rcl_interfaces/srv/ListParameters",
       "RIHS01_3e6062bfbb27bfb8730d4cef2558221f51a11646d78e7bb30a1e83afac3aad9d"},
      {"rcl_interfaces/srv/GetParameters",
       "RIHS01_bf9803d5c74cf989a5de3e0c2e99444599a627c7ff75f97b8c05b01003675cbc"},
      {"rcl_interfaces/srv/SetParameters",
       "RIHS01_56eed9a67e169f9cb6c1f987bc88f868c14a8fc9f743a263bc734c154015d7e0"},
      {"rcl_interfaces/srv/SetParametersAtomically",
       "RIHS01_0e192ef259c07fc3c07a13191d27002222e65e00ccec653ca05e856f79285fcd"},
      // Bounded sequences.
      {"rcl_interfaces/srv/DescribeParameters",
       "RIHS01_845b484d71eb0673dae682f2e3ba3c4851a65a3dcfb97bddd82c5b57e91e4cff"},
      {"rcl_interfaces/srv/GetParameterTypes",
       "RIHS01_da199c878688b3e530bdfe3ca8f74cb9fa0c303101e980a9e8f260e25e1c80ca"},
      {"simulation_interfaces/srv/SpawnEntity",
       "RIHS01_66860313e11009faddbfc8568e5d410d1a11607fe75eeb1308671dc0406fe3a7"},
      {"simulation_interfaces/srv/SpawnEntity_Request",
       "RIHS01_9bc04fe30d4844466c57b7b090fd7e9aa426995f3eb6ff9a726826ab7223e1fd"},
      {"simulation_interfaces/srv/SpawnEntity_Response",
       "RIHS01_be8c9fc03b6faaf95570949c80195c8ca75dd99f7efc23262309d497b2923982"},
  };
  for (const auto& [type, hash] : kPublished) EXPECT_EQ(TypeHashOf(type), hash) << type;
}

TEST(TypeHash, UserDataOfBothTopicsOfAServiceHasTheHashOfTheService) {
  const std::string expected = "typehash=" + TypeHashOf("rcl_interfaces/srv/GetParameters") + ";";
  EXPECT_EQ(TypeHashUserData("rcl_interfaces/srv/GetParameters_Request"), expected);
  EXPECT_EQ(TypeHashUserData("rcl_interfaces/srv/GetParameters_Response"), expected);
  EXPECT_EQ(TypeHashUserData("std_msgs/msg/Unheard"), "");
}

TEST(TypeHash, IsReadFromTheUserDataOfOtherPrograms) {
  const std::string hash = TypeHashOf("std_msgs/msg/String");
  EXPECT_EQ(TypeHashIn("enclave=/;typehash=" + hash + ";"), hash);
  EXPECT_EQ(TypeHashIn("typehash=" + hash), hash);
  EXPECT_EQ(TypeHashIn("typehash=RIHS01_" + std::string(64, 'Z') + ";"), "");
  EXPECT_EQ(TypeHashIn("typehash=RIHS01_df668c;"), "");
  EXPECT_EQ(TypeHashIn("enclave=/;"), "");
}

TEST(TypeDescription, HasBoundsButNoConstantsAndDefaults) {
  const auto description = DescribeType({"a/msg/Thing", "ros2msg",
                                         "uint8 KIND=3\nuint8 WIDE = 4\nuint8 kind 3\n"
                                         "string<=10[<=2] names # a comment\nPart[2] parts\n"
                                         "====\nMSG: a/Part\nbool on\n"});
  ASSERT_TRUE(description) << description.error().Sentence();
  EXPECT_EQ(
      CanonicalJson(*description),
      R"({"type_description": {"type_name": "a/msg/Thing", "fields": [)"
      R"({"name": "kind", "type": {"type_id": 3, "capacity": 0, "string_capacity": 0, "nested_type_name": ""}}, )"
      R"({"name": "names", "type": {"type_id": 117, "capacity": 2, "string_capacity": 10, "nested_type_name": ""}}, )"
      R"({"name": "parts", "type": {"type_id": 49, "capacity": 2, "string_capacity": 0, "nested_type_name": "a/msg/Part"}}]}, )"
      R"("referenced_type_descriptions": [{"type_name": "a/msg/Part", "fields": [)"
      R"({"name": "on", "type": {"type_id": 15, "capacity": 0, "string_capacity": 0, "nested_type_name": ""}}]}]})");
}

TEST(TypeDescription, RejectsTextThatIsNotADefinition) {
  EXPECT_FALSE(DescribeType({"a/msg/A", "ros2msg", "b/B thing\n"}));
  EXPECT_FALSE(DescribeType({"a/msg/A", "ros2msg", "uint8\n"}));
  EXPECT_FALSE(DescribeType({"a/msg/A", "ros2msg", "uint8[x] thing\n"}));
  EXPECT_FALSE(DescribeType({"a/msg/A", "ros2msg", "string<=many name\n"}));
}

TEST(ServiceNames, FollowTheMappingToDds) {
  EXPECT_EQ(RequestTopic("/gsv/spawn_entity", "simulation_interfaces/srv/SpawnEntity"),
            (ServiceTopic{"rq/gsv/spawn_entityRequest",
                          "simulation_interfaces::srv::dds_::SpawnEntity_Request_"}));
  EXPECT_EQ(ResponseTopic("/gsv/spawn_entity", "simulation_interfaces/srv/SpawnEntity"),
            (ServiceTopic{"rr/gsv/spawn_entityReply",
                          "simulation_interfaces::srv::dds_::SpawnEntity_Response_"}));
}

}  // namespace
}  // namespace gsv::ros2
