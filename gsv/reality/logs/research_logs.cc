// Reads formats in which research groups published the logs of their robots.
#include <cmath>

#include <fmt/format.h>

#include "gsv/geometry/constants.h"
#include "gsv/reality/logs/log_reader.h"
#include "gsv/reality/logs/text_rows.h"

namespace gsv::reality {
namespace {

using geometry::kInfinity;
using geometry::kPi;
namespace fs = std::filesystem;

constexpr double kMillimetre = 1e-3, kCentimetre = 1e-2, kDegree = kPi / 180;

// Replaces the part of the file name after the last underscore: "DIR/Robot1_Odometry.dat" becomes
// "DIR/Robot1_Groundtruth.dat".
fs::path Companion(const fs::path& path, const std::string& ending) {
  const std::string name = path.filename().string();
  return path.parent_path() / (name.substr(0, name.rfind('_')) + ending);
}

// Fails if the largest range of the log is below `least_credible`. Both are in `unit`. Such a log
// probably has another unit, for example metres instead of millimetres.
base::Status CheckUnit(double largest, double least_credible, const char* unit,
                       const fs::path& path) {
  if (largest >= least_credible) return {};
  return base::Fail(
      base::ErrorCode::kCorrupt,
      fmt::format(
          "the largest range is {}, so the unit is probably wrong; convert the ranges to {}",
          largest, unit),
      path.string());
}

// Reads the rows that consist of the word `first`, a time, x and y. `time_unit` is the unit of the
// times in s, and `length_unit` is that of x and y in m.
base::Result<std::vector<TimedPose>> ReadPlaces(const fs::path& path, const std::string& first,
                                                double time_unit, double length_unit,
                                                base::Problems& problems) {
  auto rows = TextRows::Open(path, problems);
  if (!rows) return base::Fail(rows.error());
  std::vector<TimedPose> places;
  std::vector<double> v;
  while (rows->Next()) {
    if (rows->word(0) != first) continue;
    if (!rows->Numbers(1, 3, v) || !rows->InOrder(v[0] * time_unit)) continue;
    places.push_back({v[0] * time_unit, v[1] * length_unit, v[2] * length_unit, 0});
  }
  if (auto done = rows->Finish(places.size()); !done) return base::Fail(done.error());
  rows->RemoveMisdated(places);
  return places;
}

}  // namespace

base::Result<Log> ReadSonarRing(const fs::path& path, base::Problems& problems) {
  constexpr std::size_t kSonars = 8;
  constexpr double kNoEcho = 5110;  // mm
  Log log;
  log.is_sonar = true;
  log.max_range = kNoEcho * kMillimetre;
  for (const double degrees : {-90.0, -37.5, -22.5, -7.5, 7.5, 22.5, 37.5, 90.0}) {
    log.beam_angles.push_back(degrees * kDegree);
  }
  auto rows = TextRows::Open(path, problems);
  if (!rows) return base::Fail(rows.error());
  std::vector<double> v;
  double largest = 0;
  while (rows->Next()) {
    if (!rows->Numbers(0, kSonars + 1, v) || !rows->InOrder(v[0] * 1e-3)) continue;
    RangeScan scan;
    scan.time = v[0] * 1e-3;
    for (std::size_t i = 1; i <= kSonars; ++i) {
      largest = std::max(largest, v[i]);
      scan.ranges.push_back(v[i] >= kNoEcho ? kInfinity : v[i] * kMillimetre);
    }
    log.scans.push_back(std::move(scan));
  }
  if (auto done = rows->Finish(log.scans.size()); !done) return base::Fail(done.error());
  rows->RemoveMisdated(log.scans);
  if (auto ok = CheckUnit(largest, 50, "millimetres", path); !ok) return base::Fail(ok.error());

  rows = TextRows::Open(path.parent_path() / "poses.txt", problems);
  if (!rows) return base::Fail(rows.error());
  while (rows->Next()) {
    if (!rows->Numbers(0, 4, v) || !rows->InOrder(v[0] * 1e-3)) continue;
    log.odometry.push_back(
        {v[0] * 1e-3, v[1] * kMillimetre, v[2] * kMillimetre, WrappedAngle(v[3] * 0.1 * kDegree)});
  }
  if (auto done = rows->Finish(log.odometry.size()); !done) return base::Fail(done.error());
  rows->RemoveMisdated(log.odometry);
  for (RangeScan& scan : log.scans) scan.base = PoseAt(log.odometry, scan.time);
  return log;
}

base::Result<Log> ReadArena(const fs::path& path, base::Problems& problems) {
  // Constants from C. Brenner's lecture on the robot: 2048 steps per turn, straight ahead is beam
  // 330, and the scanner is rotated by -4 degrees and is 30 mm in front of the middle of the
  // wheels.
  constexpr double kStep = 2 * kPi / 1024, kMounting = -4 * kDegree, kTick = 0.349 * kMillimetre;
  constexpr std::size_t kBeams = 660;
  Log log;
  log.max_range = 4.095;
  log.sensor_forward = 0.03;
  log.truth_has_yaw = false;
  for (std::size_t i = 0; i < kBeams; ++i) {
    log.beam_angles.push_back((static_cast<double>(i) - 330) * kStep + kMounting);
  }
  std::vector<double> v;
  auto rows = TextRows::Open(path, problems);
  if (!rows) return base::Fail(rows.error());
  double largest = 0;
  while (rows->Next()) {
    if (rows->word(0) != "S" || !rows->Numbers(1, kBeams + 2, v)) continue;
    if (v[1] != static_cast<double>(kBeams)) {
      rows->LeaveOut(fmt::format("the scan has {} beams; a scan of this format has 660", v[1]));
      continue;
    }
    if (!rows->InOrder(v[0] * 1e-3)) continue;
    RangeScan scan;
    scan.time = v[0] * 1e-3;
    for (std::size_t i = 2; i < v.size(); ++i) {
      largest = std::max(largest, v[i]);
      scan.ranges.push_back(v[i] <= 20 ? kInfinity : v[i] * kMillimetre);
    }
    log.scans.push_back(std::move(scan));
  }
  if (auto done = rows->Finish(log.scans.size()); !done) return base::Fail(done.error());
  rows->RemoveMisdated(log.scans);
  if (auto ok = CheckUnit(largest, 50, "millimetres", path); !ok) return base::Fail(ok.error());

  rows = TextRows::Open(Companion(path, "_motors.txt"), problems);
  if (!rows) return base::Fail(rows.error());
  std::optional<std::pair<double, double>> first;
  while (rows->Next()) {
    if (rows->word(0) != "M" || !rows->Numbers(1, 6, v) || !rows->InOrder(v[0] * 1e-3)) continue;
    if (!first) first = {v[1], v[5]};
    log.wheels.push_back(
        {v[0] * 1e-3, (v[1] - first->first) * kTick, (v[5] - first->second) * kTick});
  }
  if (auto done = rows->Finish(log.wheels.size()); !done) return base::Fail(done.error());
  rows->RemoveMisdated(log.wheels);

  auto places = ReadPlaces(Companion(path, "_reference.txt"), "P", 1e-3, kMillimetre, problems);
  if (!places) return base::Fail(places.error());
  log.truth = *std::move(places);
  return log;
}

base::Result<Log> ReadMrclam(const fs::path& path, base::Problems& problems) {
  Log log;
  std::vector<double> v;
  auto rows = TextRows::Open(path, problems);
  if (!rows) return base::Fail(rows.error());
  while (rows->Next()) {
    if (!rows->Numbers(0, 3, v) || !rows->InOrder(v[0])) continue;
    log.commands.push_back({v[0], v[1], v[2]});
  }
  if (auto done = rows->Finish(log.commands.size()); !done) return base::Fail(done.error());
  rows->RemoveMisdated(log.commands);
  rows = TextRows::Open(Companion(path, "_Groundtruth.dat"), problems);
  if (!rows) return base::Fail(rows.error());
  while (rows->Next()) {
    if (!rows->Numbers(0, 4, v) || !rows->InOrder(v[0])) continue;
    log.truth.push_back({v[0], v[1], v[2], WrappedAngle(v[3])});
  }
  if (auto done = rows->Finish(log.truth.size()); !done) return base::Fail(done.error());
  rows->RemoveMisdated(log.truth);
  return log;
}

base::Result<Log> ReadRobotData(const fs::path& path, base::Problems& problems) {
  constexpr std::size_t kBeams = 180;
  Log log;
  log.max_range = 81.83;
  log.sensor_forward = 0.25;
  for (std::size_t i = 0; i < kBeams; ++i) {
    log.beam_angles.push_back((static_cast<double>(i) - 89.5) * kDegree);
  }
  auto rows = TextRows::Open(path, problems);
  if (!rows) return base::Fail(rows.error());
  std::vector<double> v;
  double largest = 0;
  std::size_t used = 0;
  while (rows->Next()) {
    const bool is_scan = rows->word(0) == "L";
    if (!is_scan && rows->word(0) != "O") {
      rows->LeaveOut("the row must begin with L or O");
      continue;
    }
    if (!rows->Numbers(1, is_scan ? kBeams + 7 : 4, v) || !rows->InOrder(v.back())) continue;
    ++used;
    const TimedPose base{v.back(), v[0] * kCentimetre, v[1] * kCentimetre, WrappedAngle(v[2])};
    log.odometry.push_back(base);
    if (!is_scan) continue;
    RangeScan scan{base.time, {}, base};
    for (std::size_t i = 6; i < 6 + kBeams; ++i) {
      largest = std::max(largest, v[i]);
      const double range = v[i] * kCentimetre;
      scan.ranges.push_back(range <= 0 || range >= log.max_range ? kInfinity : range);
    }
    log.scans.push_back(std::move(scan));
  }
  if (auto done = rows->Finish(used); !done) return base::Fail(done.error());
  rows->RemoveMisdated(log.odometry);
  rows->RemoveMisdated(log.scans);
  if (auto ok = CheckUnit(largest, 30, "centimetres", path); !ok) return base::Fail(ok.error());
  return log;
}

base::Result<Log> ReadUwb(const fs::path& path, base::Problems& problems) {
  Log log;
  auto places = ReadPlaces(Companion(path, "_GT.txt"), "point2", 1, 1, problems);
  if (!places) return base::Fail(places.error());
  log.truth = *std::move(places);
  log.truth_has_yaw = false;
  auto rows = TextRows::Open(path, problems);
  if (!rows) return base::Fail(rows.error());
  std::vector<double> v;
  while (rows->Next()) {
    if (rows->word(0) != "range2") continue;
    if (!rows->Numbers(1, 6, v) || !rows->InOrder(v[0])) continue;
    const auto tag = PoseAt(log.truth, v[0]);
    if (!tag) continue;
    log.radio.push_back(
        {v[0], static_cast<int>(v[5]), v[1], std::hypot(tag->x - v[3], tag->y - v[4]), v[3], v[4]});
  }
  if (auto done = rows->Finish(log.radio.size()); !done) return base::Fail(done.error());
  rows->RemoveMisdated(log.radio);
  return log;
}

}  // namespace gsv::reality
