// A log of a real robot beside the same devices as GSV simulates them.
//
// Determinism  functions of the log, the options and the seed.
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

// One statistic. `confidence`: half the width of the interval in which the simulated figure lies
// with 95 %; 0 where it does not vary.
struct Row {
  std::string device, what, unit;
  double real = 0, simulated = 0, confidence = 0;
};

// The distribution of one quantity in both, for a plot.
struct Series {
  std::string what, unit;
  std::vector<double> real, simulated;
};

struct Comparison {
  std::vector<Row> rows;
  std::vector<Series> series;
};

struct CompareOptions {
  std::optional<model::WorldDescription> world;  // none: fitted to every other block of the log
  // Whether the world's walls are updated by the scans of every other block. The update shows doors
  // that are open and objects that have moved.
  bool update_world = false;
  std::string preset;            // the preset of the log's scanner or odometry
  model::Parameters parameters;  // win over the preset
  // Parameters of single sonars of a ring, by beam. They override `parameters`. May be empty.
  std::vector<model::Parameters> beam_parameters;
  std::optional<TimedPose> start;  // pose of the first scan in the world
  double wheel_distance = 0.3;     // m
  double height = 0.2;             // m: where the scanner is mounted
  std::uint64_t seed = 1;
  int runs = 20;                // number of odometry runs, with seeds from `seed` on
  std::size_t max_scans = 400;  // number of scans to simulate, evenly chosen
};

// All that the log has. kInvalidArgument for a log without anything to compare, for a preset of
// another type and for parameters that are refused.
base::Result<Comparison> Compare(const Log& log, const CompareOptions& options);

// One parameter that fits the log, and half the width of its interval of 95 %.
struct FittedParameter {
  std::string name, unit;
  double value = 0, confidence = 0;
};
struct FittedDevice {
  std::string type, name;
  std::vector<FittedParameter> parameters;
};
// Fitted to the readings of the even blocks; of odometry to all windows. Of a ring of sonars one device a beam, in
// their order. kInvalidArgument as Compare().
base::Result<std::vector<FittedDevice>> Fit(const Log& log, const CompareOptions& options);

// An SDFormat sensor for each device.
std::string ToSdf(const std::vector<FittedDevice>& devices);
// The distribution functions of all series as an SVG image.
std::string ToSvg(const Comparison& comparison);

}  // namespace gsv::reality
