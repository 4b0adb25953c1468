#include "gsv/reality/radio_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "gsv/geometry/constants.h"
#include "gsv/reality/scan_placing.h"
#include "gsv/reality/simulated_device.h"
#include "gsv/reality/statistics.h"
#include "gsv/reality/world_fit.h"

namespace gsv::reality {
namespace {

constexpr std::size_t kMinCount = 20;

std::string AnchorName(int anchor) { return fmt::format("anchor {}", anchor); }

model::PlacedModel AnchorAt(const RadioRange& range) {
  auto model = std::make_shared<model::Model>();
  model->name = "anchor";
  model->links.resize(1);
  model::PlacedModel placed;
  placed.name = AnchorName(range.anchor);
  placed.model = model;
  placed.world_from_model = geometry::PlanarPose(range.anchor_x, range.anchor_y, 0, 0);
  placed.is_static = true;
  return placed;
}

model::SensorDescription TagOf(int anchor, const CompareOptions& options) {
  model::SensorDescription tag;
  tag.type = "ranging";
  tag.name = fmt::format("ranging_{}", anchor);
  tag.parameters = options.parameters;
  tag.parameters["anchor"] = AnchorName(anchor);
  const std::string preset = PresetOf("ranging", options);
  if (!preset.empty()) tag.parameters.emplace("preset", preset);
  return tag;
}

// A line that is fitted by least squares.
struct Line {
  double at_zero = 0, slope = 0;
};
Line LineThrough(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
  }
  const double determinant = n * sxx - sx * sx;
  if (!(determinant > 1e-9)) return {n > 0 ? sy / n : 0, 0};
  const double slope = (n * sxy - sx * sy) / determinant;
  return {(sy - slope * sx) / n, slope};
}

struct RangingFit {
  double bias = 0, bias_per_metre = 0, scatter = 0, scatter_per_metre = 0;
};

RangingFit FittedTo(const std::vector<RadioRange>& ranges) {
  std::vector<double> distances, errors;
  for (const RadioRange& range : ranges) {
    distances.push_back(range.reference);
    errors.push_back(range.measured - range.reference);
  }
  const Line bias = LineThrough(distances, errors);
  // The model of the variance is a constant plus a part proportional to the square of the distance.
  std::vector<double> squares, variances;
  double mean = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    squares.push_back(distances[i] * distances[i]);
    variances.push_back(std::pow(errors[i] - bias.at_zero - bias.slope * distances[i], 2));
    mean += variances.back() / static_cast<double>(errors.size());
  }
  Line variance = LineThrough(squares, variances);
  if (variance.slope < 0 || variance.at_zero < 0) variance = {mean, 0};
  return {bias.at_zero, bias.slope, std::sqrt(variance.at_zero), std::sqrt(variance.slope)};
}

}  // namespace

base::Result<std::vector<double>> SimulatedRanges(const Log& log, const CompareOptions& options) {
  model::WorldDescription world;
  if (options.world) world = *options.world;
  std::map<int, std::vector<std::size_t>> places;  // indices in log.radio, for each anchor
  for (std::size_t i = 0; i < log.radio.size(); ++i) {
    std::vector<std::size_t>& of_anchor = places[log.radio[i].anchor];
    if (of_anchor.empty()) world.models.push_back(AnchorAt(log.radio[i]));
    of_anchor.push_back(i);
  }
  std::vector<double> ranges(log.radio.size(), geometry::kInfinity);
  for (const auto& [anchor, of_anchor] : places) {
    auto device = SimulatedDevice::Create(world, {TagOf(anchor, options)}, options.seed);
    if (!device) return base::Fail(device.error());
    for (const std::size_t i : of_anchor) {
      const auto pose = PoseAt(log.truth, log.radio[i].time);
      if (pose) ranges[i] = device->Read(*pose, static_cast<std::int64_t>(i)).at(0);
    }
  }
  return ranges;
}

std::vector<RadioGroup> Grouped(const std::vector<RadioErrors>& errors) {
  std::map<int, RadioGroup> anchors, metres;
  const auto add = [](RadioGroup& group, const RadioErrors& error) {
    group.real.push_back(error.real);
    if (std::isfinite(error.simulated)) group.simulated.push_back(error.simulated);
  };
  for (const RadioErrors& error : errors) {
    add(anchors[error.anchor], error);
    add(metres[static_cast<int>(error.distance)], error);
  }
  std::vector<RadioGroup> groups;
  const auto take = [&](RadioGroup& group, std::string name) {
    if (group.real.size() < kMinCount) return;
    group.name = std::move(name);
    groups.push_back(std::move(group));
  };
  for (auto& [anchor, group] : anchors) take(group, "to " + AnchorName(anchor));
  for (auto& [metre, group] : metres) take(group, fmt::format("from {} to {} m", metre, metre + 1));
  return groups;
}

FittedDevice FitRanging(const Log& log) {
  constexpr std::size_t kParts = 10;
  std::vector<RadioRange> fitted;
  for (const RadioRange& range : log.radio) {
    if (IsForFitting(range.time)) fitted.push_back(range);
  }
  const RangingFit all = FittedTo(fitted);
  std::vector<RangingFit> without;
  for (std::size_t part = 0; part < kParts; ++part) {
    std::vector<RadioRange> rest;
    for (std::size_t i = 0; i < fitted.size(); ++i) {
      if (i * kParts / fitted.size() != part) rest.push_back(fitted[i]);
    }
    without.push_back(FittedTo(rest));
  }
  struct Parameter {
    const char* name;
    const char* unit;
    double RangingFit::*member;
  };
  constexpr Parameter kParameters[] = {{"noise.mean", "m", &RangingFit::bias},
                                       {"bias_per_metre", "", &RangingFit::bias_per_metre},
                                       {"noise.stddev", "m", &RangingFit::scatter},
                                       {"range_noise", "", &RangingFit::scatter_per_metre}};
  FittedDevice device{"ranging", "ranging", {}};
  for (const Parameter& parameter : kParameters) {
    std::vector<double> values;
    for (const RangingFit& fit : without) values.push_back(fit.*parameter.member);
    device.parameters.push_back(
        {parameter.name, parameter.unit, all.*parameter.member, JackknifeInterval(values)});
  }
  return device;
}

}  // namespace gsv::reality
