#include "gsv/sensing/devices/odometry_drift.h"

#include <algorithm>
#include <cmath>

#include "gsv/base/random.h"

namespace gsv::sensing {

OdometryDrift ReadOdometryDrift(ParameterReader& reader) {
  OdometryDrift drift;
  drift.linear_scale = reader.Number("scale.linear", 1, 0.01, 100);
  drift.angular_scale = reader.Number("scale.angular", 1, 0.01, 100);
  drift.linear_per_metre = reader.Number("random.linear_per_metre", 0, 0, 10);
  drift.angular_per_metre = reader.Number("random.angular_per_metre", 0, 0, 10);
  drift.angular_per_radian = reader.Number("random.angular_per_radian", 0, 0, 10);
  return drift;
}

OdometryStep Drifted(const OdometryDrift& drift, OdometryStep exact, double first, double second,
                     double third) {
  const double metres = std::sqrt(std::abs(exact.way)), radians = std::sqrt(std::abs(exact.turn));
  return {drift.linear_scale * exact.way + drift.linear_per_metre * metres * first,
          drift.angular_scale * exact.turn + drift.angular_per_metre * metres * second +
              drift.angular_per_radian * radians * third};
}

void DriftState::AddToHash(base::Hash& hash) const {
  hash.Add(std::string_view(robot()));
  hash.Add(std::string_view(device()));
  for (const double value : {estimate_.x, estimate_.y, estimate_.cosine, estimate_.sine}) {
    hash.Add(value);
  }
}

geometry::PlanarPosition DriftState::EstimateAt(const world::Snapshot& now, int body,
                                                std::uint64_t seed) const {
  const geometry::PlanarPosition& place =
      now.state.bodies[static_cast<std::size_t>(body)].odometry.place;
  if (!exact_) return place;
  const double dx = place.x - exact_->x, dy = place.y - exact_->y;
  const double turn = std::atan2(place.sine * exact_->cosine - place.cosine * exact_->sine,
                                 place.cosine * exact_->cosine + place.sine * exact_->sine);
  const double ahead = exact_->cosine * dx + exact_->sine * dy;
  const double aside = exact_->cosine * dy - exact_->sine * dx;
  const double way = std::copysign(std::hypot(ahead, aside), ahead);
  if (way == 0 && turn == 0) return estimate_;
  base::Noise noise(seed, base::StableId(robot() + "/" + device() + "/drift"),
                    static_cast<std::uint64_t>(now.state.step));
  const double first = noise.Gaussian(), second = noise.Gaussian(), third = noise.Gaussian();
  const OdometryStep drifted = Drifted(drift_, {way, turn}, first, second, third);
  // Scales the exact path of the step, and rotates it to the estimated heading.
  const double stretch = way == 0 ? 0 : drifted.way / way;
  geometry::PlanarPosition estimate = estimate_;
  estimate.x += stretch * (estimate_.cosine * ahead - estimate_.sine * aside);
  estimate.y += stretch * (estimate_.sine * ahead + estimate_.cosine * aside);
  const double yaw = std::atan2(estimate_.sine, estimate_.cosine) + drifted.turn;
  estimate.cosine = std::cos(yaw), estimate.sine = std::sin(yaw);
  return estimate;
}

world::DeviceStatePtr DriftState::BeforeStep(world::DeviceStep& step) const {
  const int body = step.now->layout->Find(robot());
  if (body < 0) return nullptr;
  const geometry::PlanarPosition& place =
      step.now->state.bodies[static_cast<std::size_t>(body)].odometry.place;
  if (exact_ && exact_->x == place.x && exact_->y == place.y && exact_->cosine == place.cosine &&
      exact_->sine == place.sine) {
    return nullptr;
  }
  auto next = std::make_shared<DriftState>(*this);
  next->estimate_ = EstimateAt(*step.now, body, step.seed);
  next->exact_ = place;
  return next;
}

world::DeviceStatePtr DriftState::CarryOver(const world::Layout&,
                                            const std::vector<std::string>& placed,
                                            base::SimTime) const {
  if (std::find(placed.begin(), placed.end(), robot()) == placed.end()) return nullptr;
  return std::make_shared<const DriftState>(mount(), drift_);
}

}  // namespace gsv::sensing
