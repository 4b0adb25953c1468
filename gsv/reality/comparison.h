// Compares the log of a real robot with GSV's simulation of the same devices.
//
// Determinism  all results are functions of the log, the options and the seed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/sensor_description.h"
#include "gsv/model/world_description.h"
#include "gsv/reality/logs/log.h"
#include "gsv/reality/scan_comparison.h"

namespace gsv::reality {

// One statistic. `confidence` is half the width of the 95 % interval of the simulated value; 0 if
// the value does not vary.
struct Row {
  // Name of the device, name of the statistic, and unit of the three values.
  std::string device, what, unit;
  // The values of the log and of the simulation; NaN if there is none.
  double real = 0, simulated = 0, confidence = 0;
};

// The real and the simulated distribution of one quantity, which are plotted together.
struct Series {
  std::string what, unit;               // name and unit of the quantity
  std::vector<double> real, simulated;  // all values of the real and of the simulated device
};

// The result of a comparison: a table and the distributions to plot.
struct Comparison {
  std::vector<Row> rows;
  std::vector<Series> series;
  // A reason why the values say little about the device; empty if there is none.
  std::string warning;
};

// The world, the simulated devices and the amount of data that Compare() and Fit() use.
struct CompareOptions {
  // The world of the log. If not set, a world is fitted to every other block of 4 s of the log.
  std::optional<model::WorldDescription> world;
  // Whether the scans of every other block of 4 s update the walls of the world, for example for
  // open doors and for objects that have moved.
  bool update_world = false;
  std::string preset;            // the preset of the log's scanner, odometer or radio
  model::Parameters parameters;  // parameters that override the preset
  // Parameters of single sonars in a ring, one entry per beam, which override `parameters`. May be
  // empty.
  std::vector<model::Parameters> beam_parameters;
  // Pose of the robot at the first scan, in the world. The time of the pose is not used. If the
  // poses of the scans follow from the wheel readings only, it is the pose at the first wheel
  // reading instead: for a sonar, for a log with measured yaw, and without `world`.
  std::optional<TimedPose> start;
  double wheel_distance = 0.3;  // m
  double height = 0.2;          // height at which the scanner is mounted, m
  std::uint64_t seed = 1;
  int runs = 20;                // number of simulated odometry runs, with consecutive seeds
  std::size_t max_scans = 400;  // maximum number of simulated scans, evenly spaced in the log
};

// Compares everything that the log contains. Fails with kInvalidArgument for a log with nothing to
// compare, for a preset of another type, and for invalid parameters.
base::Result<Comparison> Compare(const Log& log, const CompareOptions& options);

// A parameter fitted to the log, and half the width of its 95 % interval.
struct FittedParameter {
  std::string name, unit;
  double value = 0, confidence = 0;
};
// A simulated device whose parameters were fitted to a log.
struct FittedDevice {
  std::string type, name;                   // sensor type, and name of the sensor in SDFormat
  std::vector<FittedParameter> parameters;  // empty if the log is too short for this device
  std::string warning = {};                 // see Comparison::warning
};
// Fits the parameters of a scanner and of radio ranges to the log's even blocks (world_fit.h). Fits
// those of odometry, and the noise of a lidar at rest, to the whole log. For a ring of sonars,
// returns one device for each beam, in beam order. Fails with kInvalidArgument in the same cases as
// Compare().
base::Result<std::vector<FittedDevice>> Fit(const Log& log, const CompareOptions& options);

// Returns an SDFormat sensor for each device.
std::string ToSdf(const std::vector<FittedDevice>& devices);
// Returns the distribution functions of all series as an SVG image.
std::string ToSvg(const Comparison& comparison);

}  // namespace gsv::reality
