// Compares simulated devices with measurements of real ones. tools/make_reality_table writes
// docs/reality.md from the output of these tests.
//
// The logs are not part of the project: GSV_REAL_DIR names the folder that contains devices/. Tests
// whose log is missing are skipped.
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "gsv/geometry/constants.h"
#include "gsv/reality/comparison.h"
#include "gsv/reality/localization.h"
#include "gsv/reality/logs/log_reader.h"
#include "gsv/reality/maps/map_world.h"
#include "gsv/reality/odometry_comparison.h"
#include "gsv/reality/scan_placing.h"
#include "gsv/reality/simulated_device.h"
#include "gsv/reality/statistics.h"
#include "gsv/reality/world_fit.h"
#include "gsv/sensing/presets.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::reality {
namespace {

using geometry::kInfinity;
using geometry::kPi;
namespace fs = std::filesystem;

constexpr double kDegree = kPi / 180;

class Reality : public testing::Test {
 protected:
  // Adds a row to the table.
  void AddResult(const std::string& what, const std::string& unit, double real, double simulated,
                 double confidence, bool is_met) {
    RecordProperty("row " + std::to_string(rows_++),
                   fmt::format("{}|{}|{:.3g}|{:.3g}|{:.2g}|{}", what, unit, real, simulated,
                               confidence, is_met ? "met" : "not met"));
  }
  // Adds the plot to the table.
  void Plot(const Comparison& comparison) { RecordProperty("plot", ToSvg(comparison)); }
  Log Read(const fs::path& path, const std::string& format) {
    auto log = ReadLog(path, format, problems_);
    EXPECT_TRUE(log) << log.error().Sentence();
    return log ? *std::move(log) : Log();
  }

  int rows_ = 0;
  base::Problems problems_;
};

class RealLog : public Reality {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("GSV_REAL_DIR");
    if (folder != nullptr) folder_ = fs::path(folder) / "devices";
    if (folder_.empty() || !fs::is_directory(folder_)) {
      GTEST_SKIP() << "GSV_REAL_DIR names no folder with logs of real devices";
    }
  }
  fs::path folder_;
};

// --- The beam of an HC-SR04 in front of a panel, with values from published plots.

model::WorldDescription TargetAt(double distance, double width, double height) {
  auto model = std::make_shared<model::Model>();
  model->links.resize(1);
  model::Collision collision;
  collision.shape = geometry::Box{{0.01, width, height}};
  model->links[0].collisions.push_back(collision);
  model::PlacedModel placed;
  placed.name = "target";
  placed.model = model;
  placed.world_from_model = geometry::PlanarPose(distance + 0.005, 0, 0, 0);
  placed.is_static = true;
  model::WorldDescription world;
  world.models.push_back(placed);
  return world;
}

// The common part of all tests of the small sonar.
class BeamTest {
 public:
  BeamTest(double threshold, double gain_range)
      : parameters_{{"threshold", threshold}, {"gain_range", gain_range}} {}

  // Returns the largest half angle (degrees) at which a panel at a distance is detected.
  double HalfAngle(double distance, double step) const {
    auto device = DeviceBefore(TargetAt(distance, 0.267, 1.22));
    double angle = 0;
    while (angle < 60 && Hears(device, (angle + step) * kDegree)) angle += step;
    return angle;
  }

  double FurthestHeard(double width, double height) const {
    double distance = 0.3;
    while (distance < 3.9) {
      auto device = DeviceBefore(TargetAt(distance + 0.02, width, height));
      if (!Hears(device, 0)) break;
      distance += 0.02;
    }
    return distance;
  }

 private:
  SimulatedDevice DeviceBefore(const model::WorldDescription& world) const {
    Log log;
    log.is_sonar = true;
    log.max_range = 4;
    log.beam_angles = {0};
    auto device = SimulatedDevice::Create(world, SensorsOf(log, "hc_sr04", parameters_, 0), 1);
    EXPECT_TRUE(device);
    return *std::move(device);
  }
  static bool Hears(SimulatedDevice& device, double turn) {
    return device.Read({0, 0, 0, turn}, 0)[0] < 3.9;
  }

  const model::Parameters parameters_;
};

struct PanelTest {
  double distance, from, to;  // m, degrees
  double half() const { return (to - from) / 2; }
};
constexpr PanelTest kPanels[] = {{.17, -24, 26},  {.32, -23, 27},  {.46, -23, 30},  {.61, -26, 30},
                                 {.76, -27, 27},  {.91, -22, 27},  {1.07, -28, 23}, {1.19, -20, 30},
                                 {1.37, -31, 35}, {1.52, -19, 28}, {1.68, -35, 32}, {1.83, -29, 29},
                                 {1.98, -29, 29}, {2.11, -31, 17}, {2.26, -15, 18}, {2.41, -23, 21},
                                 {2.57, -27, 21}};
// Maximum distances, in m, at which the real sonar detected a steel rule (25 mm wide) and a sheet
// of 33 by 38 mm.
constexpr double kRule = 2.45, kSheet = 1.68;

// Returns the errors of the half angle, in degrees, for every second entry of kPanels, beginning
// with entry `first`. `step` is the resolution of the measured half angle, in degrees.
std::vector<double> PanelErrors(const BeamTest& test, std::size_t first, double step) {
  std::vector<double> errors;
  for (std::size_t i = first; i < std::size(kPanels); i += 2) {
    errors.push_back(std::abs(test.HalfAngle(kPanels[i].distance, step) - kPanels[i].half()));
  }
  return errors;
}

// The parameters are fitted to the panel at nine distances and to the sheet. They are validated
// with the panel at the eight distances in between, and with the rule.
TEST_F(Reality, ASonarDetectsAPanelOverTheAnglesOfAnHcSr04) {
  double best = kInfinity, threshold = 0, gain_range = 0;
  for (const double t : {0.06, 0.08, 0.1, 0.12, 0.14, 0.16, 0.19, 0.22}) {
    for (const double g : {0.9, 1.1, 1.3, 1.5, 1.7, 2.0, 2.4}) {
      const BeamTest tried(t, g);
      const double sheet = std::abs(tried.FurthestHeard(0.033, 0.038) / kSheet - 1);
      // In the cost, an error of one degree counts as much as an error of a tenth of the range.
      const double cost = Summarize(PanelErrors(tried, 0, 1)).mean + 10 * sheet;
      if (cost < best) best = cost, threshold = t, gain_range = g;
    }
  }
  std::printf("threshold %.3f gain_range %.2f cost %.3f\n", threshold, gain_range, best);
  // The preset must have the values of this fit.
  for (const sensing::Preset& preset : sensing::Presets()) {
    if (preset.name != "hc_sr04") continue;
    EXPECT_EQ(model::NumberOr(preset.parameters, "threshold", 0), threshold);
    EXPECT_EQ(model::NumberOr(preset.parameters, "gain_range", 0), gain_range);
  }
  const BeamTest test(threshold, gain_range);
  const Summary fitted = Summarize(PanelErrors(test, 0, 0.5));
  const Summary judged = Summarize(PanelErrors(test, 1, 0.5));
  AddResult("judged: mean absolute error of the half angle at 8 distances (at most 3)", "°", 0,
            judged.mean, 1.96 * judged.deviation / std::sqrt(8.0), judged.mean <= 3);
  AddResult("fitted: the same at the other 9 distances (at most 3)", "°", 0, fitted.mean,
            1.96 * fitted.deviation / 3, fitted.mean <= 3);
  const double rule = test.FurthestHeard(0.025, 2), sheet = test.FurthestHeard(0.033, 0.038);
  AddResult("judged: maximum distance at which a rule of 25 mm is detected (within 20 %)", "m",
            kRule, rule, 0.02, std::abs(rule / kRule - 1) < 0.2);
  AddResult("fitted: maximum distance at which a sheet of 33 by 38 mm is detected (within 20 %)",
            "m", kSheet, sheet, 0.02, std::abs(sheet / kSheet - 1) < 0.2);
  EXPECT_LE(judged.mean, 5);
  Comparison comparison;
  comparison.series.push_back({"half angle", "°", {}, {}});
  for (const PanelTest& each : kPanels) {
    comparison.series[0].real.push_back(each.half());
    comparison.series[0].simulated.push_back(test.HalfAngle(each.distance, 0.5));
  }
  Plot(comparison);
}

// --- Robots with motion capture: the parameters are fitted to two robots and validated with a
// third robot.

TEST_F(RealLog, OdometryDriftEqualsThatOfARobotThatWasNotFitted) {
  std::vector<MotionWindow> fitted;
  for (const char* robot : {"Robot1", "Robot2"}) {
    const Log log = Read(folder_ / "mrclam" / (std::string(robot) + "_Odometry.dat"), "mrclam");
    const auto windows = Windows(ReckonedPath(log, 1, log.truth.front()), log.truth, 5);
    const MotionStatistics one = StatisticsOf(windows);
    std::printf("%s: %zu windows, way %.3f turn %.3f scatter %.4f m %.4f rad\n", robot,
                windows.size(), one.way_ratio, one.turn_ratio, one.way_scatter, one.turn_scatter);
    fitted.insert(fitted.end(), windows.begin(), windows.end());
  }
  const sensing::OdometryDrift drift = FitDrift(fitted);
  std::printf("fit: scale %.4f %.4f random %.4f %.4f %.4f\n", drift.linear_scale,
              drift.angular_scale, drift.linear_per_metre, drift.angular_per_metre,
              drift.angular_per_radian);
  const Log log = Read(folder_ / "mrclam" / "Robot3_Odometry.dat", "mrclam");
  CompareOptions options;
  options.parameters = {{"scale.linear", drift.linear_scale},
                        {"scale.angular", drift.angular_scale},
                        {"random.linear_per_metre", drift.linear_per_metre},
                        {"random.angular_per_metre", drift.angular_per_metre},
                        {"random.angular_per_radian", drift.angular_per_radian}};
  const auto comparison = Compare(log, options);
  ASSERT_TRUE(comparison) << comparison.error().Sentence();
  Plot(*comparison);
  for (const Row& row : comparison->rows) {
    const bool is_target = row.what.starts_with("true ") || row.what.starts_with("scatter");
    if (!is_target) continue;
    const bool is_met = std::abs(row.simulated / row.real - 1) <= 0.1;
    AddResult(row.what + " (within 10 %)", row.unit, row.real, row.simulated, row.confidence,
              is_met);
    // Robots of the same type differ by about 10 %. So a value may deviate by 10 % plus its
    // confidence interval.
    EXPECT_NEAR(row.simulated, row.real, 0.1 * row.real + row.confidence) << row.what;
  }
  // The preset must have the values of this fit.
  for (const sensing::Preset& preset : sensing::Presets()) {
    if (preset.name != "irobot_create") continue;
    EXPECT_NEAR(model::NumberOr(preset.parameters, "scale.linear", 0), drift.linear_scale, 0.005);
    EXPECT_NEAR(model::NumberOr(preset.parameters, "scale.angular", 0), drift.angular_scale, 0.005);
    EXPECT_NEAR(model::NumberOr(preset.parameters, "random.linear_per_metre", 0),
                drift.linear_per_metre, 0.005);
    EXPECT_NEAR(model::NumberOr(preset.parameters, "random.angular_per_metre", 0),
                drift.angular_per_metre, 0.005);
    EXPECT_NEAR(model::NumberOr(preset.parameters, "random.angular_per_radian", 0),
                drift.angular_per_radian, 0.005);
  }
}

// --- A ring of sonars along a corridor.

TEST_F(RealLog, ASonarRingDetectsAsManyEchoesAsARealOne) {
  const Log log = Read(folder_ / "sonar_ring" / "measurement.txt", "sonar-ring");
  CompareOptions options;
  options.preset = "polaroid_6500";
  options.parameters = {{"min", 0.0}, {"second_reflections", false}, {"target_size", false}};
  const auto devices = Fit(log, options);
  ASSERT_TRUE(devices) << devices.error().Sentence();
  for (const FittedDevice& device : *devices) {
    options.beam_parameters.emplace_back();
    for (const FittedParameter& parameter : device.parameters) {
      std::printf("%s %s %.4g ± %.2g\n", device.name.c_str(), parameter.name.c_str(),
                  parameter.value, parameter.confidence);
      options.beam_parameters.back()[parameter.name] = parameter.value;
    }
  }
  const auto comparison = Compare(log, options);
  ASSERT_TRUE(comparison) << comparison.error().Sentence();
  Plot(*comparison);
  for (const Row& row : comparison->rows) {
    std::printf("%s: %.3f %.3f\n", row.what.c_str(), row.real, row.simulated);
    if (!row.what.starts_with("share of beams with an echo")) continue;
    AddResult(row.what + " (within 0.1)", "", row.real, row.simulated, row.confidence,
              std::abs(row.real - row.simulated) <= 0.1);
    EXPECT_NEAR(row.simulated, row.real, 0.3) << row.what;
  }
}

// --- A laser in a mapped building.

TEST_F(RealLog, ALaserHasTheNoiseAndLostEchoesOfARealOne) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("gsv-wean-{}", ::getpid());
  fs::create_directories(folder);
  const std::string unpack =
      fmt::format("gzip -dc '{}' > '{}'", (folder_ / "wean/wean.dat.gz").string(),
                  (folder / "wean.dat").string());
  ASSERT_EQ(std::system(unpack.c_str()), 0);
  const auto map = ReadBeesoftMap(folder / "wean.dat");
  fs::remove_all(folder);
  ASSERT_TRUE(map) << map.error().Sentence();
  const Log log = Read(folder_ / "wean" / "robotdata1.log", "robotdata");
  CompareOptions options;
  options.world = WallsOf(*map, 1);
  options.preset = "sick_lms";
  options.update_world = true;
  options.max_scans = 300;
  const auto devices = Fit(log, options);
  ASSERT_TRUE(devices) << devices.error().Sentence();
  for (const FittedParameter& parameter : devices->front().parameters) {
    std::printf("%s %.4g ± %.2g\n", parameter.name.c_str(), parameter.value, parameter.confidence);
    options.parameters[parameter.name] = parameter.value;
  }
  const auto comparison = Compare(log, options);
  ASSERT_TRUE(comparison) << comparison.error().Sentence();
  Plot(*comparison);
  for (const Row& row : comparison->rows) {
    std::printf("%s: %.4f %.4f\n", row.what.c_str(), row.real, row.simulated);
    if (row.what == "scatter of a beam at rest") {
      const bool is_met = row.simulated >= 0.005 && row.simulated <= 0.012;
      AddResult(row.what + " (0.005 to 0.012)", "m", row.real, row.simulated, row.confidence,
                is_met);
      EXPECT_TRUE(is_met) << row.simulated;
    }
    if (row.what == "share of all beams at the maximum") {
      const bool is_met = row.simulated >= 0.005 && row.simulated <= 0.037;
      AddResult(row.what + " (0.005 to 0.037)", "", row.real, row.simulated, row.confidence,
                is_met);
      EXPECT_TRUE(is_met) << row.simulated;
    }
    if (row.what == "share of hits" || row.what == "share of shorter readings" ||
        row.what == "share without an echo") {
      AddResult(row.what + " (within 0.05)", "", row.real, row.simulated, row.confidence,
                std::abs(row.real - row.simulated) <= 0.05);
    }
  }
}

// --- An arena that can be rebuilt: six cylinders in a square of 2 m.

model::WorldDescription Arena(const fs::path& landmarks) {
  constexpr double kSide = 2, kThick = 0.02;
  model::WorldDescription world;
  const auto add = [&](const std::string& name, const geometry::Shape& shape, double x, double y) {
    auto model = std::make_shared<model::Model>();
    model->links.resize(1);
    model::Collision collision;
    collision.shape = shape;
    model->links[0].collisions.push_back(collision);
    model::PlacedModel placed;
    placed.name = name;
    placed.model = model;
    placed.world_from_model = geometry::PlanarPose(x, y, 0.25, 0);
    placed.is_static = true;
    world.models.push_back(placed);
  };
  const geometry::Box along{{kSide, kThick, 0.5}}, across{{kThick, kSide, 0.5}};
  add("bottom", along, kSide / 2, -kThick / 2);
  add("top", along, kSide / 2, kSide + kThick / 2);
  add("left", across, -kThick / 2, kSide / 2);
  add("right", across, kSide + kThick / 2, kSide / 2);
  std::ifstream file(landmarks);
  std::string l, c;
  double x = 0, y = 0, radius = 0;  // mm
  for (int i = 0; file >> l >> c >> x >> y >> radius; ++i) {
    add("cylinder " + std::to_string(i), geometry::Cylinder{radius / 1000, 0.5}, x / 1000,
        y / 1000);
  }
  return world;
}

// A robot with two wheels that is too small to touch anything.
std::shared_ptr<model::Model> Tracker(double wheel_distance) {
  constexpr double kRadius = 0.01;
  auto model = std::make_shared<model::Model>(*simulation::Disc(kRadius));
  model->sensors.clear();
  for (const double side : {1.0, -1.0}) {
    model->links.push_back({});
    model::Joint joint;
    joint.name = side > 0 ? "left" : "right";
    joint.kind = model::JointKind::kContinuous;
    joint.parent = 0;
    joint.child = static_cast<int>(model->links.size()) - 1;
    joint.model_from_joint = geometry::PlanarPose(0, side * wheel_distance / 2, kRadius, 0);
    joint.axis = {0, 1, 0};
    model->joints.push_back(joint);
  }
  model->drive->kind = model::DriveKind::kDifferential;
  model->drive->left_wheels = {0};
  model->drive->right_wheels = {1};
  model->drive->wheel_separation = wheel_distance;
  model->drive->wheel_radius = kRadius;
  return model;
}

// Records the path of the robot.
class PathObserver final : public simulation::Observer {
 public:
  explicit PathObserver(double first) : first_(first) {}
  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override {
    const int body = snapshot->layout->Find("robot");
    if (body < 0) return;
    const geometry::Pose& pose =
        snapshot->state.bodies[static_cast<std::size_t>(body)].world_from_model;
    path.push_back({first_ + base::ToSeconds(snapshot->state.time), pose.position.x,
                    pose.position.y, geometry::ToRollPitchYaw(pose.orientation).yaw});
  }
  void OnEvent(const simulation::Event&) override {}

  std::vector<TimedPose> path;

 private:
  const double first_;
};

// Simulates the robot of the motor log in a world. Returns its pose after each step.
std::vector<TimedPose> Driven(model::WorldDescription world, const Log& log, double wheel_distance,
                              const TimedPose& start) {
  const double first = log.wheels.front().time;
  auto behaviour = std::make_shared<simulation::ThreadBehaviour>(
      [&](simulation::Agent& agent, simulation::ClockId clock) {
        for (std::size_t i = 1; i < log.wheels.size(); ++i) {
          const double step = log.wheels[i].time - log.wheels[i - 1].time;
          if (!(step > 0)) continue;
          const double left = (log.wheels[i].left - log.wheels[i - 1].left) / step;
          const double right = (log.wheels[i].right - log.wheels[i - 1].right) / step;
          if (!agent.Command({(left + right) / 2, 0, (right - left) / wheel_distance})) return;
          const auto until = base::FromSeconds(log.wheels[i].time - first);
          if (!simulation::SleepFor(agent, clock, until - agent.Now())) return;
        }
      });
  // The step equals the resolution of the log's clock.
  world.max_step_size = std::chrono::milliseconds(1);
  simulation::Specification specification =
      simulation::Lockstep(base::FromSeconds(log.wheels.back().time - first));
  specification.world = std::make_shared<model::WorldDescription>(std::move(world));
  auto simulation = simulation::Make(std::move(specification));
  auto observer = std::make_shared<PathObserver>(first);
  simulation->AddObserver(observer);
  simulation::RobotSpecification robot = simulation::Robot("robot", 0, 0, behaviour);
  robot.world_from_robot = geometry::PlanarPose(start.x, start.y, 0, start.yaw);
  robot.model = Tracker(wheel_distance);
  EXPECT_TRUE(simulation->AddRobot(std::move(robot)));
  EXPECT_EQ(simulation::RunToEnd(*simulation), simulation::Phase::kFinished);
  return observer->path;
}

// Returns the distance between `place` and the path's pose at the same time. Before the first pose
// and after the last one, the robot does not move.
double ErrorAt(const std::vector<TimedPose>& path, const TimedPose& place) {
  const TimedPose there =
      PoseAt(path, place.time)
          .value_or(place.time < path.front().time ? path.front() : path.back());
  return std::hypot(there.x - place.x, there.y - place.y);
}

struct PathErrors {
  double rms = 0, largest = 0, end = 0;
};
PathErrors ErrorsOf(const std::vector<TimedPose>& path, const std::vector<TimedPose>& truth) {
  PathErrors errors;
  for (const TimedPose& place : truth) {
    errors.end = ErrorAt(path, place);
    errors.rms += errors.end * errors.end / static_cast<double>(truth.size());
    errors.largest = std::max(errors.largest, errors.end);
  }
  errors.rms = std::sqrt(errors.rms);
  return errors;
}

// The motor log drives a simulated robot in the rebuilt arena. Wheel distance and first heading are
// chosen so that the path by exact arcs is closest to the camera's path.
TEST_F(RealLog, WheelOdometryMatchesTheArenaLog) {
  const Log log = Read(folder_ / "arena" / "robot4_scan.txt", "arena");
  double best = kInfinity, distance = 0;
  TimedPose start = log.truth.front();
  std::vector<TimedPose> reckoned;
  for (double wheels = 0.14; wheels < 0.2; wheels += 0.001) {
    for (double heading = 203; heading <= 223; heading += 0.5) {
      const TimedPose from{0, log.truth.front().x, log.truth.front().y, heading * kDegree};
      auto path = ReckonedPath(log, wheels, from);
      const double rms = ErrorsOf(path, log.truth).rms;
      if (rms < best) best = rms, distance = wheels, start = from, reckoned = std::move(path);
    }
  }
  const auto path =
      Driven(Arena(folder_ / "arena" / "robot_arena_landmarks.txt"), log, distance, start);
  ASSERT_FALSE(path.empty());
  // The simulated path must agree with `reckoned`, which was computed with exact arcs.
  double apart = 0;
  for (const TimedPose& place : reckoned) apart = std::max(apart, ErrorAt(path, place));
  EXPECT_LT(apart, 0.01);
  const PathErrors errors = ErrorsOf(path, log.truth);
  std::printf("wheels %.3f rms %.4f max %.4f end %.4f apart %.4f\n", distance, errors.rms,
              errors.largest, errors.end, apart);
  const auto row = [&](const char* what, double real, double simulated) {
    AddResult(std::string(what) + " (within 20 %)", "m", real, simulated, 0,
              std::abs(simulated / real - 1) <= 0.2);
    EXPECT_NEAR(simulated, real, 0.2 * real) << what;
  };
  row("rms distance of the driven path from the camera's", 0.059, errors.rms);
  row("largest distance", 0.103, errors.largest);
  row("distance at the end", 0.084, errors.end);
}

// Scans in the same arena. The bias of the laser is fitted to the log's even blocks (world_fit.h).
TEST_F(RealLog, ALaserScansTheArena) {
  const Log log = Read(folder_ / "arena" / "robot4_scan.txt", "arena");
  CompareOptions options;
  options.world = Arena(folder_ / "arena" / "robot_arena_landmarks.txt");
  options.preset = "hokuyo_urg";
  options.wheel_distance = 0.172;
  options.start = {0, log.truth.front().x, log.truth.front().y, 213 * kDegree};
  double best = kInfinity, bias = 0;
  for (const double tried : {0.0, -0.01, -0.02, -0.03}) {
    options.parameters["noise.mean"] = tried;
    const auto placed = PlaceScans(log, options, true);
    ASSERT_TRUE(placed) << placed.error().Sentence();
    const auto pairs = PairScans(*placed, log, options);
    ASSERT_TRUE(pairs) << pairs.error().Sentence();
    const double off = Summarize(MedianDifferences(*pairs)).mean;
    std::printf("bias %.3f: %.4f\n", tried, off);
    if (off < best) best = off, bias = tried;
  }
  options.parameters["noise.mean"] = bias;
  const auto comparison = Compare(log, options);
  ASSERT_TRUE(comparison) << comparison.error().Sentence();
  Plot(*comparison);
  for (const Row& row : comparison->rows) {
    std::printf("%s: %.4f %.4f\n", row.what.c_str(), row.real, row.simulated);
    if (row.what == "scatter of a beam at rest") {
      const bool is_met = row.simulated >= 0.002 && row.simulated <= 0.004;
      AddResult(row.what + " (0.002 to 0.004)", "m", row.real, row.simulated, row.confidence,
                is_met);
      EXPECT_TRUE(is_met) << row.simulated;
    } else if (row.what == "median difference of a scan, middle") {
      AddResult(row.what + " (below 0.01)", "m", 0, row.real, 0, row.real < 0.01);
      EXPECT_LT(row.real, 0.01);
    } else if (row.what == "median difference of a scan, largest") {
      AddResult(row.what + " (below 0.01)", "m", 0, row.real, 0, row.real < 0.01);
      EXPECT_LT(row.real, 0.05);
    } else if (row.what.starts_with("share of scans with")) {
      AddResult(row.what + " (1)", "", 1, row.real, 0, row.real == 1);
    }
  }
}

// --- Ranges to radio anchors: fitted to the even blocks, validated with the odd ones.

TEST_F(RealLog, RadioRangesHaveTheBiasAndScatterOfUwb) {
  const Log log = Read(folder_ / "uwb" / "Indoor_UWB_Input.txt", "uwb");
  CompareOptions options;
  const auto devices = Fit(log, options);
  ASSERT_TRUE(devices) << devices.error().Sentence();
  ASSERT_EQ(devices->front().type, "ranging");
  const sensing::Preset* uwb = nullptr;
  for (const sensing::Preset& preset : sensing::Presets()) {
    if (preset.name == "uwb_indoor") uwb = &preset;
  }
  ASSERT_NE(uwb, nullptr);
  for (const FittedParameter& parameter : devices->front().parameters) {
    std::printf("%s %.5g ± %.2g\n", parameter.name.c_str(), parameter.value, parameter.confidence);
    // The preset must have the values of this fit.
    EXPECT_NEAR(model::NumberOr(uwb->parameters, parameter.name, 0), parameter.value, 5e-4)
        << parameter.name;
  }
  options.preset = "uwb_indoor";
  const auto comparison = Compare(log, options);
  ASSERT_TRUE(comparison) << comparison.error().Sentence();
  Plot(*comparison);
  for (const Row& row : comparison->rows) {
    std::printf("%s: %.4f %.4f\n", row.what.c_str(), row.real, row.simulated);
    const bool is_bias = row.what.starts_with("bias to");
    if (!is_bias && !row.what.starts_with("scatter to")) continue;
    const double low = is_bias ? 0.07 : 0.06, high = is_bias ? 0.15 : 0.13;
    const bool is_met = row.simulated >= low && row.simulated <= high;
    AddResult(fmt::format("{} ({} to {})", row.what, low, high), "m", row.real, row.simulated,
              row.confidence, is_met);
    EXPECT_TRUE(is_met) << row.what << ' ' << row.simulated;
  }
}

}  // namespace
}  // namespace gsv::reality
