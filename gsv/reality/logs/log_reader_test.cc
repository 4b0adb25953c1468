#include "gsv/reality/logs/log_reader.h"

#include <cmath>

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"

namespace gsv::reality {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class LogReaderTest : public testing::Test {
 protected:
  Log Read(const std::filesystem::path& path, const std::string& format) {
    auto log = ReadLog(path, format, problems_);
    EXPECT_TRUE(log) << log.error().Sentence();
    return log ? *log : Log();
  }
  std::string Refusal(const std::filesystem::path& path, const std::string& format) {
    auto log = ReadLog(path, format, problems_);
    EXPECT_FALSE(log);
    return log ? "" : log.error().Sentence();
  }
  std::string Problem(std::size_t i) const {
    return i < problems_.size() ? problems_[i].Sentence() : "none";
  }

  base::testing::TestFolder folder_;
  base::Problems problems_;
};

// ODOM x y theta tv rv accel ipc_time host logger_time
const char* const kOdometry =
    "# CARMEN Logfile\n"
    "ODOM 0 0 0 0.5 0 0 100.0 host 0.0\n"
    "ODOM 0.5 0 0.1 0.5 0.1 0 101.0 host 1.0\n";

TEST_F(LogReaderTest, ReadsTheOdometryOfACarmenLog) {
  const Log log = Read(folder_.Write("a.log", kOdometry), "carmen");
  ASSERT_THAT(log.odometry, SizeIs(2));
  EXPECT_EQ(log.odometry[1].x, 0.5);
  EXPECT_EQ(log.odometry[1].time, 1);
  EXPECT_EQ(log.commands[1].angular, 0.1);
  EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(LogReaderTest, GuessesTheFormatFromNameAndFirstLines) {
  const auto guess = [](const std::filesystem::path& path) {
    const auto format = GuessLogFormat(path);
    return format ? *format : format.error().Sentence();
  };
  EXPECT_EQ(guess(folder_.Write("a.log", kOdometry)), "carmen");
  EXPECT_EQ(guess(folder_.Write("b.log", "O 1 2 0.5 0.1\n")), "robotdata");
  EXPECT_EQ(guess("Robot1_Odometry.dat"), "mrclam");
  EXPECT_EQ(guess("r4_scan.txt"), "arena");
  EXPECT_EQ(guess("Indoor_Input.txt"), "uwb");
  EXPECT_EQ(guess("ring/measurement.txt"), "sonar-ring");
  EXPECT_EQ(guess("run.mcap"), "mcap");
  EXPECT_THAT(guess(folder_.Write("c.log", "hello\n")), HasSubstr("Use --as with one of"));
  EXPECT_THAT(guess("/nowhere/d.log"), HasSubstr("Use --as"));
}

TEST_F(LogReaderTest, ReadsAScanOfACarmenLogFromRightToLeft) {
  const Log log =
      Read(folder_.Write("a.log", "FLASER 3 1.0 2.0 81.9 5 6 0.2 0 0 0 9 host 4\n"), "carmen");
  ASSERT_THAT(log.scans, SizeIs(1));
  EXPECT_THAT(log.scans[0].ranges, ElementsAre(1.0, 2.0, geometry::kInfinity));
  EXPECT_WITHIN(log.beam_angles[0], -geometry::kPi / 2, 1e-12, "rad");
  EXPECT_WITHIN(log.beam_angles[2], geometry::kPi / 2, 1e-12, "rad");
  EXPECT_EQ(log.scans[0].base->y, 6);
}

TEST_F(LogReaderTest, NamesTheLineOfWhatIsNoNumber) {
  std::string text = kOdometry;
  for (int i = 2; i < 20; ++i) text += "ODOM 0 0 0 0 0 0 0 host " + std::to_string(i) + "\n";
  text += "ODOM nan 0 0 0 0 0 0 host 20\n";
  const auto path = folder_.Write("a.log", text);
  EXPECT_THAT(Read(path, "carmen").odometry, SizeIs(20));
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_EQ(Problem(0), path.string() +
                            ":22: field 2 is \"nan\"; it must be a finite number; the row is "
                            "ignored");
}

TEST_F(LogReaderTest, ReportsTimeThatGoesBackAndAClockThatJumps) {
  std::string text = kOdometry;
  for (int i = 2; i < 20; ++i) text += "ODOM 0 0 0 0 0 0 0 host " + std::to_string(i) + "\n";
  text += "ODOM 0 0 0 0 0 0 0 host 3\nODOM 0 0 0 0 0 0 0 host 500\n";
  Read(folder_.Write("a.log", text), "carmen");
  ASSERT_THAT(problems_, SizeIs(2));
  EXPECT_THAT(Problem(0), HasSubstr("a.log:22: time goes back from 19 to 3 s"));
  EXPECT_THAT(Problem(1), HasSubstr("a.log:23: the clock jumps from 19 to 500 s"));
}

TEST_F(LogReaderTest, RefusesALogOfAnotherFormat) {
  EXPECT_THAT(Refusal(folder_.Write("a.log", "hello world\n"), "carmen"),
              HasSubstr("no row can be used; is the format (--as) the right one?"));
  EXPECT_THAT(Refusal(folder_.path() / "b.log", "carmen"), HasSubstr("b.log: no such file"));
  EXPECT_THAT(Refusal(folder_.path() / "b.log", "log"),
              HasSubstr("there is no log format \"log\"; the formats are sonar-ring, "));
  EXPECT_THAT(Refusal(folder_.Write("a.mcap", "no recording"), "mcap"), HasSubstr("a.mcap"));
}

TEST_F(LogReaderTest, RefusesALogThatIsCutOffEverywhere) {
  EXPECT_THAT(Refusal(folder_.Write("a.log", std::string(kOdometry) + "ODOM 0 0\n"), "carmen"),
              HasSubstr("1 of 3 rows cannot be used"));
  EXPECT_THAT(Problem(0), HasSubstr("the row has 3 fields and needs 7; it may be cut off"));
}

TEST_F(LogReaderTest, RefusesAScanThatClaimsTooManyReadings) {
  Refusal(folder_.Write("a.log", "FLASER 1e9 1 2 3\n"), "carmen");
  EXPECT_THAT(Problem(0), HasSubstr("the scan has 1000000000 readings; it must have 1 to 10000"));
}

TEST_F(LogReaderTest, ReadsASonarRing) {
  folder_.Write("poses.txt", "1000 0 0 0\n2000 500 0 900\n");
  const Log log = Read(
      folder_.Write("measurement.txt", "1000 1000 5110 1 1 1 1 1 2000\n1500 5110 1 1 1 1 1 1 60\n"),
      "sonar-ring");
  EXPECT_THAT(log.scans[0].ranges,
              ElementsAre(1, geometry::kInfinity, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 2));
  EXPECT_WITHIN(log.scans[1].base->x, 0.25, 1e-12, "m");
  EXPECT_WITHIN(log.scans[1].base->yaw, geometry::kPi / 4, 1e-12, "rad");
}

TEST_F(LogReaderTest, RefusesASonarRingInMetres) {
  folder_.Write("poses.txt", "1000 0 0 0\n");
  EXPECT_THAT(Refusal(folder_.Write("measurement.txt", "1000 1 5.11 1 1 1 1 1 2\n"), "sonar-ring"),
              HasSubstr("the largest range is 5.11; this format counts millimetres"));
}

TEST_F(LogReaderTest, ReadsMotionCaptureBesideCommands) {
  folder_.Write("Robot1_Groundtruth.dat", "# x\n10 1 2 3\n10.5 1 2 -3\n");
  const Log log = Read(folder_.Write("Robot1_Odometry.dat", "10.0 0.1 0.2\n"), "mrclam");
  ASSERT_THAT(log.truth, SizeIs(2));
  EXPECT_EQ(log.commands[0].linear, 0.1);
  // The yaw goes from 3 to -3 through pi.
  EXPECT_WITHIN(WrappedAngle(PoseAt(log.truth, 0.25)->yaw - geometry::kPi), 0, 1e-12, "rad");
}

TEST_F(LogReaderTest, ReadsRangesToRadioAnchors) {
  folder_.Write("Hall_GT.txt", "point2 1 3 0 0 0 0 0\n");
  const Log log =
      Read(folder_.Write("Hall_Input.txt", "range2 1 5.1 0.01 0 4 105 0\nodom2diff 1\n"), "uwb");
  ASSERT_THAT(log.radio, SizeIs(1));
  EXPECT_EQ(log.radio[0].anchor, 105);
  EXPECT_EQ(log.radio[0].measured, 5.1);
  EXPECT_EQ(log.radio[0].reference, 5);
}

TEST(PoseAt, GivesNothingAcrossAGap) {
  const std::vector<TimedPose> poses = {{0, 0, 0, 0}, {5, 1, 0, 0}};
  EXPECT_FALSE(PoseAt(poses, 2));
  EXPECT_FALSE(PoseAt(poses, 6));
  EXPECT_TRUE(PoseAt(poses, 0));
}

}  // namespace
}  // namespace gsv::reality
