#include "gsv/rendering/cameras/shutter.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "gsv/rendering/lenses/light_encoding.h"

namespace gsv::rendering {

std::shared_ptr<const world::Snapshot> Earlier(const world::Snapshot& snapshot, double seconds) {
  auto earlier = std::make_shared<world::Snapshot>(snapshot);
  for (world::BodyState& body : earlier->state.bodies) {
    geometry::Pose& pose = body.world_from_model;
    pose.position = pose.position - seconds * body.linear_velocity;
    const double speed = Norm(body.angular_velocity);
    if (speed == 0) continue;
    const geometry::Vector3 axis = (1 / speed) * body.angular_velocity;
    pose.orientation =
        Normalized(geometry::FromAxisAngle(axis, -seconds * speed) * pose.orientation);
  }
  std::vector<double>& positions = earlier->state.joint_positions;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] -= seconds * snapshot.state.joint_velocities[i];
  }
  return earlier;
}

Shutter::Shutter(sensing::ParameterReader& reader)
    : exposure_time_(reader.Number("exposure_time", 0, 0, 10)),
      readout_time_(reader.Number("readout_time", 0, 0, 10)),
      samples_(reader.Count("shutter_samples", 8, 2, 64)) {}

double Shutter::Age(int sample) const {
  return (exposure_time_ + readout_time_) * (1 - (sample + 0.5) / samples_);
}

std::pair<int, int> Shutter::SamplesOf(int row, int height) const {
  constexpr double kRounding = 1e-9;  // tolerance for rounding, as a fraction of a sample
  const double newest = readout_time_ * (1 - (row + 0.5) / height);
  const double per_second = samples_ / (exposure_time_ + readout_time_);
  // Returns the sample at which Age(sample) equals `age`.
  const auto at = [&](double age) { return samples_ - 0.5 - age * per_second; };
  const int first = static_cast<int>(std::ceil(at(newest + exposure_time_) - kRounding));
  const int last = static_cast<int>(std::floor(at(newest) + kRounding));
  if (first <= last) return {std::max(first, 0), std::min(last, samples_ - 1)};
  const int nearest = static_cast<int>(std::lround(at(newest + 0.5 * exposure_time_)));
  const int one = std::clamp(nearest, 0, samples_ - 1);
  return {one, one};
}

base::Result<Shutter::ImagePtr> Shutter::Take(const SnapshotPtr& snapshot, const Draw& draw) const {
  if (exposure_time_ == 0 && readout_time_ == 0) return draw(snapshot);
  std::vector<ImagePtr> images;
  for (int sample = 0; sample < samples_; ++sample) {
    auto image = draw(Earlier(*snapshot, Age(sample)));
    if (!image) return image;
    images.push_back(*std::move(image));
  }
  auto taken = std::make_shared<model::Image>(*images.back());
  const std::size_t row_size = taken->pixels.size() / static_cast<std::size_t>(taken->height);
  for (int row = 0; row < taken->height; ++row) {
    const auto [first, last] = SamplesOf(row, taken->height);
    const std::size_t begin = static_cast<std::size_t>(row) * row_size;
    for (std::size_t i = begin; i < begin + row_size; ++i) {
      float light = 0;
      for (int sample = first; sample <= last; ++sample) {
        light += LightOf(images[static_cast<std::size_t>(sample)]->pixels[i]);
      }
      taken->pixels[i] = NumberFor(light / static_cast<float>(last - first + 1));
    }
  }
  return taken;
}

}  // namespace gsv::rendering
