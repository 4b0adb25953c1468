#include "gsv/readings/catalogue.h"

#include <gtest/gtest.h>

namespace gsv::readings {
namespace {

using Doubles = std::vector<double>;
using Names = std::vector<std::string>;

TEST(Readings, AreReadInTheOrderOfTheirFields) {
  const auto charge = Decode<Battery>(Doubles{12, 0.5, 4, 5, 0.8}, Names{}, "battery");
  ASSERT_TRUE(charge);
  EXPECT_EQ(charge->voltage, 12);
  EXPECT_EQ(charge->current, 0.5);
  EXPECT_EQ(charge->charge, 4);
  EXPECT_EQ(charge->capacity, 5);
  EXPECT_EQ(charge->fraction, 0.8);
}

TEST(Readings, ListsAreDecodedFromGroupsOfValuesAndLabels) {
  const Contact touched{
      {{"wall", {1, 2, 3}, {0, 0, 1}, 0.25, 0.5, {7, 8, 9}}, {"floor", {4, 5, 6}, {}, 0, 0, {}}}};
  Doubles values;
  Names labels;
  Append(touched, values, labels);
  EXPECT_EQ(values,
            (Doubles{1, 2, 3, 0, 0, 1, 0.25, 0.5, 7, 8, 9, 4, 5, 6, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(labels, (Names{"wall", "floor"}));
  const auto back = Decode<Contact>(values, labels, "bumper");
  ASSERT_TRUE(back);
  ASSERT_EQ(back->touches.size(), 2u);
  EXPECT_EQ(back->touches[1].other, "floor");
  EXPECT_EQ(back->touches[1].point.z, 6);
  EXPECT_EQ(back->touches[0].closing_speed, 0.5);
  EXPECT_TRUE(Decode<Contact>(Doubles{}, Names{}, "bumper")->touches.empty());
}

TEST(Readings, OptionalFieldsMayBeMissingAtTheEnd) {
  const Doubles six{1, 2, 3, 4, 5, 6};
  EXPECT_FALSE(Decode<Imu>(six, Names{}, "imu")->world_from_sensor);
  const Doubles ten{1, 2, 3, 4, 5, 6, 0.5, -0.5, 0.5, -0.5};
  EXPECT_EQ(Decode<Imu>(ten, Names{}, "imu")->world_from_sensor->z, -0.5);
  EXPECT_EQ(Decode<Odometry>(six, Names{}, "wheels")->lateral, 6);
  EXPECT_EQ(Decode<Odometry>(Doubles{1, 2, 3, 4, 5}, Names{}, "wheels")->lateral, 0);
}

TEST(Readings, ImagesReferToTheirPixels) {
  const Doubles values{2, 1, 0.5, 1.5};
  const auto image = Decode<DepthImage>(values, Names{}, "eye");
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width, 2);
  EXPECT_EQ(image->depth.data(), values.data() + 2);
}

template <typename Struct>
std::string Refusal(const Doubles& values, const Names& labels = {}) {
  const auto decoded = Decode<Struct>(values, labels, "front");
  return decoded ? "" : decoded.error().Sentence();
}

TEST(Readings, WrongSizeIsAnErrorWithExpectedAndFoundSize) {
  EXPECT_EQ(Refusal<Sonar>({}),
            "front: a reading has the wrong size: expected 1 value, found 0 values and 0 labels");
  EXPECT_EQ(Refusal<Imu>({1, 2, 3, 4, 5, 6, 7}),
            "front: a reading has the wrong size: expected 6 or 10 values, found 7 values and 0 "
            "labels");
  EXPECT_EQ(
      Refusal<Contact>({1, 2, 3, 4, 5, 6, 7, 8, 9}, {"wall", "floor"}),
      "front: a reading has the wrong size: expected groups of 11 values and 1 label, found 9 "
      "values and 2 labels");
  EXPECT_EQ(Refusal<DepthImage>({2, 2, 1, 1, 1}),
            "front: a reading has the wrong size: expected 2 values, then groups of 1 value, found "
            "5 values and 0 labels");
  EXPECT_EQ(Refusal<Microphone>({30, 0}),
            "front: a reading has the wrong size: expected 2 values and 1 label, found 2 values "
            "and 0 labels");
  EXPECT_FALSE(Refusal<Sonar>({1}, {"a name"}).empty());
}

TEST(Readings, ImagesOfInvalidSizesAreRejected) {
  EXPECT_FALSE(Refusal<DepthImage>({-1, -1, 1}).empty());
  EXPECT_FALSE(Refusal<DepthImage>({1e300, 1, 1}).empty());
  EXPECT_FALSE(Refusal<DepthImage>({65536, 65536}).empty());
}

TEST(Layout, DescribesTheFieldsOfAReading) {
  EXPECT_EQ(LayoutOf<Sonar>().Text(), "range (m)");
  EXPECT_EQ(LayoutOf<Imu>().Text(),
            "angular_velocity.x, .y, .z (rad/s), specific_force.x, .y, .z (m/s²); perhaps "
            "world_from_sensor.w, .x, .y, .z");
  EXPECT_EQ(LayoutOf<Microphone>().Text(), "level (dB), frequency (Hz) [source]");
  EXPECT_EQ(LayoutOf<LogicalCamera>().Text(),
            "each: sensor_from_model.x, .y, .z (m), .roll, .pitch, .yaw (rad) [each: name]");
  EXPECT_EQ(LayoutOf<DepthImage>().Text(), "width, height (px); then each: depth (m)");
}

TEST(Layout, ReturnsTheUnitsOfMessageFields) {
  using Units = std::map<std::string, std::string>;
  EXPECT_EQ(LayoutOf<Odometry>().Units(), (Units{{"pose.pose.position", "m"},
                                                 {"pose.pose.orientation", "rad"},
                                                 {"twist.twist.linear", "m/s"},
                                                 {"twist.twist.angular", "rad/s"}}));
  EXPECT_EQ(LayoutOf<LogicalCamera>().Units(),
            (Units{{"detections.bbox.center.position", "m"},
                   {"detections.bbox.center.orientation", "rad"}}));
  EXPECT_TRUE(LayoutOf<JointEncoders>().Units().empty());
}

}  // namespace
}  // namespace gsv::readings
