// Reads logs of CARMEN: https://carmen.sourceforge.net (the header of every log lists the
// messages).
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>

#include "gsv/geometry/constants.h"
#include "gsv/reality/logs/log_reader.h"
#include "gsv/reality/logs/text_rows.h"

namespace gsv::reality {
namespace {

using geometry::kInfinity;
using geometry::kPi;

constexpr std::size_t kMaxBeams = 10'000;

class CarmenReader {
 public:
  CarmenReader(TextRows rows, Log& log) : rows_(std::move(rows)), log_(log) {}

  base::Status Read() {
    while (rows_.Next()) {
      const std::string_view kind = rows_.word(0);
      if (kind == "ODOM") {
        Odometry();
      } else if (kind == "FLASER") {
        FrontLaser();
      } else if (kind == "ROBOTLASER1") {
        RobotLaser();
      } else if (kind == "TRUEPOS") {
        TruePosition();
      } else {
        ++others_;
      }
    }
    if (used_ == 0 && others_ > 0) {
      rows_.Warn("the log has no ODOM, FLASER, ROBOTLASER1 or TRUEPOS");
    }
    const base::Status done = rows_.Finish(used_);
    rows_.RemoveMisdated(log_.odometry);
    rows_.RemoveMisdated(log_.commands);
    rows_.RemoveMisdated(log_.truth);
    rows_.RemoveMisdated(log_.scans);
    if (!done) return done;
    if (auto units = CheckUnits(); !units) return units;
    if (!has_stated_maximum_) FindMaximum();
    return {};
  }

 private:
  // Reads the logger's time, which is the last word of each message.
  bool Time(double& time) {
    std::vector<double> last;
    if (!rows_.Numbers(rows_.size() - 1, 1, last) || !rows_.InOrder(last[0])) return false;
    time = last[0];
    return true;
  }

  void Odometry() {
    std::vector<double> v;
    double time = 0;
    if (!rows_.Numbers(1, 6, v) || !Time(time)) return;
    log_.odometry.push_back({time, v[0], v[1], Heading(v[2])});
    log_.commands.push_back({time, v[3], v[4]});
    ++used_;
  }

  void TruePosition() {
    std::vector<double> v;
    double time = 0;
    if (!rows_.Numbers(1, 6, v) || !Time(time)) return;
    log_.truth.push_back({time, v[0], v[1], WrappedAngle(v[2])});
    ++used_;
  }

  // Returns the number of readings, which is the word at index `place`; 0 if the word is not an
  // integer from 1 to kMaxBeams.
  std::size_t BeamCount(std::size_t place) {
    std::vector<double> v;
    if (!rows_.Numbers(place, 1, v)) return 0;
    if (!(v[0] >= 1 && v[0] <= double{kMaxBeams}) || v[0] != std::floor(v[0])) {
      rows_.LeaveOut(
          fmt::format("the scan has {} readings; it must have 1 to {}", v[0], kMaxBeams));
      return 0;
    }
    return static_cast<std::size_t>(v[0]);
  }

  void FrontLaser() {
    const std::size_t count = rows_.size() > 1 ? BeamCount(1) : 0;
    std::vector<double> v;
    double time = 0;
    if (count == 0 || !rows_.Numbers(2, count + 6, v)) return;
    // With 180 readings, beams are between the whole degrees. With 181 readings, they are at whole
    // degrees.
    const bool has_both_ends = count % 2 == 1;
    const double step = kPi / static_cast<double>(has_both_ends ? count - 1 : count);
    if (!Angles(-kPi / 2 + (has_both_ends ? 0 : step / 2), step, count) || !Time(time)) return;
    AddScan(time, {v.begin(), v.begin() + static_cast<std::ptrdiff_t>(count)},
            {time, v[count], v[count + 1], Heading(v[count + 2])});
  }

  // The words of a message: type start fov resolution max accuracy remission_mode n r… n_remissions
  // … laser pose, robot pose
  void RobotLaser() {
    std::vector<double> head, v;
    double time = 0;
    if (!rows_.Numbers(1, 8, head)) return;
    const std::size_t count = BeamCount(8);
    if (count == 0 || !rows_.Numbers(9, count + 1, v)) return;
    const double remissions = v[count];
    if (!(remissions >= 0 && remissions <= double{kMaxBeams})) {
      rows_.LeaveOut(
          fmt::format("the scan has {} remissions; it must have 0 to {}", remissions, kMaxBeams));
      return;
    }
    std::vector<double> pose;
    if (!rows_.Numbers(10 + count + static_cast<std::size_t>(remissions), 6, pose)) return;
    if (!Angles(head[1], head[3], count) || !Time(time)) return;
    log_.sensor_forward =
        (pose[0] - pose[3]) * std::cos(pose[5]) + (pose[1] - pose[4]) * std::sin(pose[5]);
    if (head[4] > 0) {
      log_.max_range = head[4];
      has_stated_maximum_ = true;
    }
    AddScan(time, {v.begin(), v.begin() + static_cast<std::ptrdiff_t>(count)},
            {time, pose[3], pose[4], WrappedAngle(pose[5])});
  }

  bool Angles(double first, double step, std::size_t count) {
    if (log_.beam_angles.empty()) {
      for (std::size_t i = 0; i < count; ++i) {
        log_.beam_angles.push_back(first + static_cast<double>(i) * step);
      }
    }
    if (log_.beam_angles.size() == count) return true;
    rows_.LeaveOut(fmt::format("the scan has {} readings; the first one had {}", count,
                               log_.beam_angles.size()));
    return false;
  }

  void AddScan(double time, std::vector<double> ranges, const TimedPose& base) {
    for (double& range : ranges) {
      if (range <= 0 || range >= log_.max_range) range = kInfinity;
    }
    log_.scans.push_back({time, std::move(ranges), base});
    ++used_;
  }

  // Detects wrong units: ranges in cm or mm exceed the maximum, and headings in degrees are in the
  // hundreds.
  base::Status CheckUnits() const {
    // The maximum heading is in rad. It is larger than 2 pi, because a log may count several turns.
    constexpr double kMaxFractionWithoutEcho = 0.95, kMaxHeading = 100;
    std::size_t without = 0, readings = 0;
    for (const RangeScan& scan : log_.scans) {
      readings += scan.ranges.size();
      without +=
          static_cast<std::size_t>(std::count(scan.ranges.begin(), scan.ranges.end(), kInfinity));
    }
    if (readings > 0 &&
        static_cast<double>(without) > kMaxFractionWithoutEcho * static_cast<double>(readings)) {
      return base::Fail(
          base::ErrorCode::kCorrupt,
          fmt::format("{:.0f} % of the ranges are 0, or {} m or more, so their unit is probably "
                      "wrong; convert the ranges to metres",
                      100 * static_cast<double>(without) / static_cast<double>(readings),
                      log_.max_range),
          rows_.path().string());
    }
    if (largest_heading_ > kMaxHeading) {
      return base::Fail(base::ErrorCode::kCorrupt,
                        fmt::format("a heading is {:.0f} rad, so its unit is probably wrong; "
                                    "convert the headings to radians",
                                    largest_heading_),
                        rows_.path().string());
    }
    return {};
  }

  double Heading(double yaw) {
    largest_heading_ = std::max(largest_heading_, std::abs(yaw));
    return WrappedAngle(yaw);
  }

  // A reading without an echo equals the scanner's maximum range, which FLASER messages do not
  // contain. The largest reading in the log is the maximum range if it occurs many times, because
  // echoes do not repeat one distance so often.
  void FindMaximum() {
    constexpr double kShare = 0.001, kShortestMaximum = 2;  // m
    constexpr std::size_t kMinRepetitions = 20;
    double largest = 0;
    std::size_t count = 0, readings = 0;
    for (const RangeScan& scan : log_.scans) {
      for (const double range : scan.ranges) {
        if (!std::isfinite(range)) continue;
        ++readings;
        if (range > largest) largest = range, count = 0;
        if (range == largest) ++count;
      }
    }
    if (largest < kShortestMaximum || count < kMinRepetitions ||
        static_cast<double>(count) < kShare * static_cast<double>(readings)) {
      return;
    }
    rows_.Warn(fmt::format("the largest reading, {} m, occurs {} times; it is read as \"no echo\"",
                           largest, count));
    log_.max_range = largest;
    for (RangeScan& scan : log_.scans) {
      for (double& range : scan.ranges) {
        if (range >= largest) range = kInfinity;
      }
    }
  }

  TextRows rows_;
  Log& log_;
  bool has_stated_maximum_ = false;
  double largest_heading_ = 0;
  std::size_t used_ = 0, others_ = 0;
};

}  // namespace

base::Result<Log> ReadCarmen(const std::filesystem::path& path, base::Problems& problems) {
  auto rows = TextRows::Open(path, problems);
  if (!rows) return base::Fail(rows.error());
  Log log;
  // Maximum range of the SICK LMS, the scanner of most of these logs. ROBOTLASER1 messages contain
  // the maximum range of their scanner.
  log.max_range = 81;
  if (auto read = CarmenReader(*std::move(rows), log).Read(); !read) {
    return base::Fail(read.error());
  }
  return log;
}

}  // namespace gsv::reality
