#include "gsv/reality/logs/log_reader.h"

#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"
#include "gsv/messages/cdr.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/messages/tf2_msgs.h"
#include "gsv/recording/mcap/mcap_writer.h"

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

// The words of an odometry message: ODOM x y theta tv rv accel ipc_time host logger_time
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

TEST_F(LogReaderTest, FindsTheReadingWithoutAnEchoOfACarmenLog) {
  std::string text;
  for (int i = 0; i < 30; ++i) {
    text += "FLASER 3 1." + std::to_string(i) + " 50.0 2 5 6 0 0 0 0 9 host " + std::to_string(i) +
            "\n";
  }
  const Log log = Read(folder_.Write("a.log", text), "carmen");
  ASSERT_THAT(log.scans, SizeIs(30));
  EXPECT_EQ(log.max_range, 50);
  EXPECT_THAT(log.scans[7].ranges, ElementsAre(1.7, geometry::kInfinity, 2.0));
  EXPECT_THAT(Problem(0), HasSubstr("the largest reading, 50 m, occurs 30 times"));
}

TEST_F(LogReaderTest, RefusesACarmenLogInOtherUnits) {
  std::string centimetres, degrees;
  for (int i = 0; i < 10; ++i) {
    const std::string time = std::to_string(i) + "\n";
    centimetres += "FLASER 3 166 250 812 5 6 0 0 0 0 9 host " + time;
    degrees += "ODOM 0 0 " + std::to_string(20 * i) + " 0 0 0 9 host " + time;
  }
  EXPECT_THAT(Refusal(folder_.Write("a.log", centimetres), "carmen"),
              HasSubstr("so their unit is probably wrong; convert the ranges to metres"));
  EXPECT_THAT(
      Refusal(folder_.Write("b.log", degrees), "carmen"),
      HasSubstr("a heading is 180 rad, so its unit is probably wrong; convert the headings"));
}

TEST_F(LogReaderTest, TakesTheMountOfTheScannerFromACarmenLog) {
  // The robot faces north at (1, 2), and the laser is 0.3 m ahead of it.
  const Log log = Read(folder_.Write("a.log",
                                     "ROBOTLASER1 0 -1.5708 3.1416 1.5708 20 0.01 0 3 1 2 3 0 "
                                     "1 2.3 1.570796 1 2 1.570796 0 0 0 0 0 9 host 4\n"),
                       "carmen");
  ASSERT_THAT(log.scans, SizeIs(1));
  EXPECT_EQ(log.max_range, 20);
  EXPECT_WITHIN(log.sensor_forward, 0.3, 1e-6, "m");
  EXPECT_EQ(log.scans[0].base->y, 2);
}

TEST_F(LogReaderTest, NamesTheLineOfAnInvalidNumber) {
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

// A log with one row at each of `times`. The reader must return the rows at the times `read`, and
// skip `left_out` rows.
struct Dated {
  std::vector<double> times;
  std::vector<double> read;
  std::size_t left_out;
};

TEST_F(LogReaderTest, SkipsOnlyTheRowsWhoseTimeIsWrong) {
  std::vector<double> whole;
  for (int i = 0; i < 40; ++i) whole.push_back(i);
  const auto with = [&](std::size_t at, std::vector<double> rows) {
    std::vector<double> times = whole;
    times.insert(times.begin() + static_cast<std::ptrdiff_t>(at), rows.begin(), rows.end());
    return times;
  };
  const auto without = [&](std::size_t at) {
    std::vector<double> times = whole;
    times.erase(times.begin() + static_cast<std::ptrdiff_t>(at));
    return times;
  };
  const std::vector<Dated> cases{
      {with(20, {4e9}), whole, 1},   // one row is far in the future
      {with(20, {21.5}), whole, 1},  // one row is a little in the future
      {with(0, {1e6}), whole, 1},    // the first row is far in the future
      {with(20, {900, 901, 902}), whole, 3},
      {with(20, {3.5}), whole, 1},   // one row is far in the past
      {with(20, {18.5}), whole, 1},  // one row is a little in the past
      {with(40, {38.5}), whole, 1},  // the last row is in the past
  };
  for (const Dated& of : cases) {
    std::string text;
    for (const double time : of.times)
      text += "ODOM 0 0 0 0 0 0 0 host " + std::to_string(time) + "\n";
    problems_.clear();
    const Log log = Read(folder_.Write("a.log", text), "carmen");
    std::vector<double> read;
    for (const TimedPose& pose : log.odometry) read.push_back(pose.time);
    EXPECT_EQ(read, of.read);
    EXPECT_EQ(log.commands.size(), of.read.size());
    EXPECT_THAT(problems_, SizeIs(of.left_out));
  }
  // Two neighbouring rows are swapped. The reader skips the second of them, as its time goes back.
  std::vector<double> swapped = whole;
  std::swap(swapped[20], swapped[21]);
  std::string text;
  for (const double time : swapped)
    text += "ODOM 0 0 0 0 0 0 0 host " + std::to_string(time) + "\n";
  problems_.clear();
  const auto path = folder_.Write("a.log", text);
  EXPECT_THAT(Read(path, "carmen").odometry, SizeIs(without(20).size()));
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_EQ(Problem(0), path.string() + ":22: time goes back from 21 to 20 s; the row is ignored");
}

TEST_F(LogReaderTest, NamesTheRowWhoseTimeIsAhead) {
  std::string text = kOdometry;
  for (int i = 2; i < 20; ++i) text += "ODOM 0 0 0 0 0 0 0 host " + std::to_string(i) + "\n";
  text += "ODOM 0 0 0 0 0 0 0 host 7000\nODOM 0 0 0 0 0 0 0 host 20\nODOM 0 0 0 0 0 0 0 host 21\n";
  const auto path = folder_.Write("a.log", text);
  EXPECT_THAT(Read(path, "carmen").odometry, SizeIs(22));
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_EQ(Problem(0),
            path.string() +
                ":22: its time, 7000 s, is later than the time of a row after it, 20 s; the "
                "row is ignored");
}

TEST_F(LogReaderTest, RefusesALogOfAnotherFormat) {
  EXPECT_THAT(Refusal(folder_.Write("a.log", "hello world\n"), "carmen"),
              HasSubstr("no row can be used; is the format (--as) the right one?"));
  EXPECT_THAT(Refusal(folder_.path() / "b.log", "carmen"), HasSubstr("b.log: no such file"));
  EXPECT_THAT(Refusal(folder_.path() / "b.log", "log"),
              HasSubstr("there is no log format \"log\"; the formats are sonar-ring, "));
  EXPECT_THAT(Refusal(folder_.Write("a.mcap", "no recording"), "mcap"), HasSubstr("a.mcap"));
}

// Writes messages to a recording.
class Recording {
 public:
  explicit Recording(const std::filesystem::path& path)
      : writer_(recording::McapWriter::Create(path.string(), {.replace = true}).value()) {}
  template <typename Message>
  void Write(const std::string& topic, double time, const Message& message) {
    messages::Bytes bytes;
    messages::Encode(message, bytes);
    const auto channel = writer_->AddChannel(topic, messages::SchemaOf<Message>());
    ASSERT_TRUE(channel);
    writer_->Write(*channel, base::FromSeconds(time), std::as_bytes(std::span(bytes)));
  }
  void Close() { EXPECT_TRUE(writer_->Close()); }

 private:
  std::unique_ptr<recording::McapWriter> writer_;
};

messages::tf2_msgs::TFMessage Transform(const std::string& parent, const std::string& child,
                                        double x) {
  messages::tf2_msgs::TFMessage message;
  auto& transform = message.transforms.emplace_back();
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.translation.x = x;
  transform.transform.rotation.z = std::sqrt(0.5);
  transform.transform.rotation.w = std::sqrt(0.5);
  return message;
}

TEST_F(LogReaderTest, ReadsARecordingsScansTransformsAndCommands) {
  const auto path = folder_.path() / "a.mcap";
  Recording recording(path);
  messages::sensor_msgs::LaserScan scan;
  scan.angle_min = -1;
  scan.angle_increment = 1;
  scan.range_min = 0.1f;
  scan.range_max = 8;
  scan.ranges = {2, 9, 4};
  for (const double time : {0.0, 1.0, 2.0}) {
    recording.Write("/tf", time, Transform("map", "robot/base_link", time));
    recording.Write("/tf", time, Transform("robot/odom", "robot/base_link", 2 * time));
    recording.Write("/tf", time, Transform("map", "other/base_link", 9));
    recording.Write("/tf", time, Transform("robot/base_link", "robot/wheel", 9));
  }
  recording.Write("/robot/scan", 1.5, scan);
  messages::gsv_msgs::Command command;
  command.robot = "robot";
  command.linear_m_s = 0.5;
  recording.Write("/gsv/commands", 1.5, command);
  recording.Write("/robot/scan", 50, scan);
  recording.Close();
  const Log log = Read(path, "mcap");
  ASSERT_THAT(log.truth, SizeIs(3));
  EXPECT_EQ(log.truth[2].x, 2);
  EXPECT_WITHIN(log.truth[2].yaw, geometry::kPi / 2, 1e-9, "rad");
  ASSERT_THAT(log.odometry, SizeIs(3));
  EXPECT_EQ(log.odometry[2].x, 4);
  ASSERT_THAT(log.commands, SizeIs(1));
  EXPECT_EQ(log.commands[0].linear, 0.5);
  ASSERT_THAT(log.scans, SizeIs(2));
  EXPECT_THAT(log.scans[0].ranges, ElementsAre(2, geometry::kInfinity, 4));
  EXPECT_THAT(log.beam_angles, ElementsAre(-1, 0, 1));
  ASSERT_TRUE(log.scans[0].base);
  EXPECT_EQ(log.scans[0].base->x, 1.5);
  EXPECT_FALSE(log.scans[1].base);
  ASSERT_THAT(problems_, SizeIs(2));
  EXPECT_THAT(Problem(0), HasSubstr("the clock jumps from 2 to 50 s"));
  EXPECT_THAT(Problem(1), HasSubstr("the transform from map to other/base_link is not read: the "
                                    "transform from map to robot/base_link is used for the truth"));
}

TEST_F(LogReaderTest, RefusesEveryTruncationOfALog) {
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

// Without its first scan, the log can be compared: localization starts at the first scan.
TEST_F(LogReaderTest, IgnoresScansBeforeTheFirstPose) {
  folder_.Write("poses.txt", "1000 0 0 0\n2000 500 0 900\n");
  const Log log =
      Read(folder_.Write("measurement.txt", "900 1 1 1 1 1 1 1 1\n1500 2000 1 1 1 1 1 1 60\n"),
           "sonar-ring");
  ASSERT_THAT(log.scans, SizeIs(1));
  EXPECT_EQ(log.scans[0].ranges[0], 2);
  EXPECT_WITHIN(log.scans[0].base->x, 0.25, 1e-12, "m");
  EXPECT_THAT(Problem(0), HasSubstr("ignored 1 scan before the first pose"));
}

TEST_F(LogReaderTest, RefusesASonarRingInMetres) {
  folder_.Write("poses.txt", "1000 0 0 0\n");
  EXPECT_THAT(
      Refusal(folder_.Write("measurement.txt", "1000 1 5.11 1 1 1 1 1 2\n"), "sonar-ring"),
      HasSubstr("the largest range is 5.11, so the unit is probably wrong; convert the ranges "
                "to millimetres"));
}

TEST_F(LogReaderTest, ReadsMotionCaptureBesideCommands) {
  folder_.Write("Robot1_Groundtruth.dat", "# x\n10 1 2 3\n10.5 1 2 -3\n");
  const Log log = Read(folder_.Write("Robot1_Odometry.dat", "10.0 0.1 0.2\n"), "mrclam");
  ASSERT_THAT(log.truth, SizeIs(2));
  EXPECT_EQ(log.commands[0].linear, 0.1);
  // The yaw changes from 3 to -3, through pi.
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
