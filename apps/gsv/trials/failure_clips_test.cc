#include "apps/gsv/trials/failure_clips.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gsv::app {
namespace {

using ::testing::ElementsAre;

nlohmann::ordered_json Report() {
  return nlohmann::ordered_json::parse(R"({"sim_time_s": 20, "expectations": [
    {"holds": false, "time_s": 12.4}, {"holds": true, "time_s": 1}, {"holds": false, "time_s": 3.13}]})");
}

TEST(FailureClips, ViolationTimesAreInAscendingOrder) {
  EXPECT_THAT(ViolationTimes(Report()), ElementsAre(3.13, 12.4));
}

TEST(FailureClips, UsesTheEndOfTheRunIfThereIsNoViolation) {
  EXPECT_THAT(ViolationTimes({{"sim_time_s", 7.5}}), ElementsAre(7.5));
}

TEST(FailureClips, OneClipSpansNearViolations) {
  const auto clips = ClipsOf({3.13, 12.4}, 10, 2);
  ASSERT_EQ(clips.size(), 1u);
  EXPECT_EQ(clips[0].from, 0);
  EXPECT_EQ(clips[0].to, 14.4);
  EXPECT_THAT(clips[0].violations, ElementsAre(3.13, 12.4));
}

TEST(FailureClips, DistantViolationHasItsOwnClip) {
  const auto clips = ClipsOf({50, 170, 170.5}, 10, 2);
  ASSERT_EQ(clips.size(), 2u);
  EXPECT_EQ(clips[0].from, 40);
  EXPECT_EQ(clips[0].to, 172);
  EXPECT_EQ(clips[1].from, 160.5);
  EXPECT_EQ(clips[1].to, 172.5);
  EXPECT_THAT(clips[1].violations, ElementsAre(170.5));
}

TEST(FailureClips, NumberOfClipsIsLimited) {
  std::vector<double> times;
  for (int i = 0; i < 20; ++i) times.push_back(1000.0 * i);
  const auto clips = ClipsOf(times, 10, 2);
  ASSERT_EQ(clips.size(), kMaxClips);
  EXPECT_EQ(clips.back().violations.back(), 1000.0 * (kMaxClips - 1));
}

}  // namespace
}  // namespace gsv::app
