#include "gsv/messages/cdr.h"

#include <initializer_list>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/messages/all.h"
#include "gsv/messages/time.h"

namespace gsv::messages {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;

Bytes BytesOf(std::initializer_list<int> values) {
  Bytes bytes;
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

template <typename Message>
Bytes Encoded(const Message& message) {
  Bytes bytes;
  Encode(message, bytes);
  return bytes;
}

// The expected bytes in these tests were written by hand from the rules at the top of cdr.h.

TEST(Cdr, WritesAHeaderThenLittleEndianFields) {
  EXPECT_THAT(Encoded(builtin_interfaces::Time{-2, 0x01020304}),
              ElementsAreArray(BytesOf({0, 1, 0, 0, 0xfe, 0xff, 0xff, 0xff, 4, 3, 2, 1})));
}

TEST(Cdr, WritesTheLengthAndTheNulOfAString) {
  EXPECT_THAT(Encoded(std_msgs::String{"hi"}),
              ElementsAreArray(BytesOf({0, 1, 0, 0, 3, 0, 0, 0, 'h', 'i', 0})));
  EXPECT_THAT(Encoded(std_msgs::String{}), ElementsAreArray(BytesOf({0, 1, 0, 0, 1, 0, 0, 0, 0})));
}

TEST(Cdr, AlignsAFieldToItsSizeCountedFromTheHeadersEnd) {
  // Counted from the end of the header, the string occupies bytes 20 to 24. The next field, 0.5 =
  // 0x3fe0000000000000, begins at byte 32, the next multiple of eight.
  gsv_msgs::Command command;
  command.stamp = {1, 2};
  command.step = 3;
  command.robot = "abcd";
  command.linear_m_s = 0.5;
  command.lateral_m_s = 0;
  command.angular_rad_s = -0.5;
  EXPECT_THAT(Encoded(command),
              ElementsAreArray(BytesOf({0, 1, 0, 0,                           //
                                        1, 0, 0, 0, 2,   0,   0,    0,        // stamp
                                        3, 0, 0, 0, 0,   0,   0,    0,        // step
                                        5, 0, 0, 0, 'a', 'b', 'c',  'd',  0,  // robot
                                        0, 0, 0, 0, 0,   0,   0,              // to 32
                                        0, 0, 0, 0, 0,   0,   0xe0, 0x3f,     //
                                        0, 0, 0, 0, 0,   0,   0,    0,        //
                                        0, 0, 0, 0, 0,   0,   0xe0, 0xbf})));
}

TEST(Cdr, EncodesAnEmptySequenceAsACountWithoutPadding) {
  gsv_msgs::Poses poses;
  poses.layout_version = 7;
  EXPECT_THAT(Encoded(poses), ElementsAreArray(BytesOf({0, 1, 0, 0,                  //
                                                        0, 0, 0, 0, 0, 0, 0, 0,      // stamp
                                                        0, 0, 0, 0, 0, 0, 0, 0,      // step
                                                        7, 0, 0, 0, 0, 0, 0, 0})));  // 0 poses
}

TEST(Cdr, PadsASequenceOfDoublesAfterItsCount) {
  sensor_msgs::JointState state;
  state.position = {2.0};                                            // 0x4000000000000000
  EXPECT_THAT(Encoded(state), ElementsAreArray(BytesOf({0, 1, 0, 0,  //
                                                        0, 0, 0, 0, 0, 0, 0, 0,
                                                        1, 0, 0, 0, 0, 0, 0, 0,     // header
                                                        0, 0, 0, 0,                 // name
                                                        1, 0, 0, 0,                 // at 20
                                                        0, 0, 0, 0, 0, 0, 0, 0x40,  // at 24
                                                        0, 0, 0, 0, 0, 0, 0, 0})));
}

TEST(Cdr, EncodesOneByteFieldsWithoutPadding) {
  sensor_msgs::NavSatStatus status{sensor_msgs::NavSatStatus::kStatusNoFix,
                                   sensor_msgs::NavSatStatus::kServiceGalileo};
  EXPECT_THAT(Encoded(status), ElementsAreArray(BytesOf({0, 1, 0, 0, 0xff, 0, 8, 0})));
}

TEST(Cdr, AppendsToTheContentOfTheBuffer) {
  Bytes bytes = BytesOf({9, 9, 9});
  Encode(builtin_interfaces::Time{1, 2}, bytes);
  EXPECT_THAT(bytes, ElementsAreArray(BytesOf({9, 9, 9, 0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0})));
}

TEST(Cdr, BlockOfPointsIsReadBack) {
  visualization_msgs::Marker marker;
  marker.ns = "robot";
  marker.points = {{1, 2, 3}, {4, 5, 6}};
  marker.colors = {{0.25F, 0.5F, 0.75F, 1}};
  marker.text = "beam";
  const auto decoded = Decode<visualization_msgs::Marker>(Encoded(marker));
  ASSERT_TRUE(decoded) << decoded.error().Sentence();
  EXPECT_EQ(*decoded, marker);
}

TEST(Cdr, RejectsATruncatedMessage) {
  const Bytes bytes = Encoded(builtin_interfaces::Time{1, 2});
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto decoded = Decode<builtin_interfaces::Time>(std::span(bytes).first(size));
    ASSERT_FALSE(decoded) << size;
    EXPECT_EQ(decoded.error().code, base::ErrorCode::kCorrupt);
    EXPECT_EQ(decoded.error().where, "builtin_interfaces/msg/Time");
  }
}

TEST(Cdr, RejectsACountThatExceedsTheMessage) {
  Bytes bytes = Encoded(tf2_msgs::TFMessage{});
  for (int i = 4; i < 8; ++i) bytes[i] = std::byte{0xff};
  const auto decoded = Decode<tf2_msgs::TFMessage>(bytes);
  ASSERT_FALSE(decoded);
  EXPECT_THAT(decoded.error().Sentence(), HasSubstr("more elements than the message has room"));
}

TEST(Cdr, RejectsAStringWithoutItsNul) {
  const auto decoded = Decode<std_msgs::String>(BytesOf({0, 1, 0, 0, 2, 0, 0, 0, 'h', 'i'}));
  ASSERT_FALSE(decoded);
  EXPECT_THAT(decoded.error().Sentence(), HasSubstr("does not end in NUL"));
}

TEST(Cdr, RejectsBigEndian) {
  const auto decoded =
      Decode<builtin_interfaces::Time>(BytesOf({0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2}));
  ASSERT_FALSE(decoded);
  EXPECT_THAT(decoded.error().Sentence(), HasSubstr("little-endian"));
}

TEST(Cdr, AcceptsPaddingAtTheEndButNotAnotherField) {
  Bytes bytes = Encoded(builtin_interfaces::Time{1, 2});
  bytes.resize(bytes.size() + 3);
  EXPECT_TRUE(Decode<builtin_interfaces::Time>(bytes));
  bytes.resize(bytes.size() + 1);
  EXPECT_FALSE(Decode<builtin_interfaces::Time>(bytes));
}

TEST(Cdr, DecodesAnyNonZeroBoolAsTrue) {
  sensor_msgs::RegionOfInterest region;
  region.do_rectify = true;
  Bytes bytes = Encoded(region);
  bytes.back() = std::byte{0x80};
  const auto decoded = Decode<sensor_msgs::RegionOfInterest>(bytes);
  ASSERT_TRUE(decoded);
  EXPECT_EQ(*decoded, region);
}

TEST(Schema, ContainsTheDefinitionAndItsDependencies) {
  const std::string rule(80, '=');
  EXPECT_EQ(SchemaOf<std_msgs::Header>().name, "std_msgs/msg/Header");
  EXPECT_EQ(SchemaOf<std_msgs::Header>().encoding, "ros2msg");
  EXPECT_EQ(SchemaOf<std_msgs::Header>().text,
            "builtin_interfaces/Time stamp\nstring frame_id\n" + rule +
                "\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
}

TEST(Time, SplitsIntoSecondsAndNanoseconds) {
  const base::SimTime time = std::chrono::nanoseconds(3'000'000'007);
  EXPECT_EQ(ToMessage(time), (builtin_interfaces::Time{3, 7}));
  EXPECT_EQ(ToSimTime(ToMessage(time)), time);
}

}  // namespace
}  // namespace gsv::messages
