// Errors of odometry that accumulate. They have two causes: the true size or distance of the wheels
// differs from the robot's parameters, and the wheels slip randomly.
//
// Model        in each step, the robot travels the distance ds and turns by da. The odometry
//              measures ds' = scale.linear ds + a random part of variance random.linear_per_metre^2
//              |ds|. It measures da' = scale.angular da + a random part of variance
//              random.angular_per_metre^2 |ds| + random.angular_per_radian^2 |da|. So the variance
//              over a distance does not depend on the length of the steps.
// Source       Thrun, Burgard and Fox, "Probabilistic Robotics", section 5.4. The coefficients
//              there are variances.
// Determinism  each step's draws are keyed by (seed, robot, sensor, step).
#pragma once

#include <optional>

#include "gsv/geometry/planar_motion.h"
#include "gsv/sensing/parameters.h"
#include "gsv/world/device_state.h"
#include "gsv/world/device_step.h"

namespace gsv::sensing {

// The parameters of accumulating odometry errors. A scale is the measured value divided by the true
// value.
struct OdometryDrift {
  double linear_scale = 1, angular_scale = 1;  // for the distance and for the change of heading
  double linear_per_metre = 0;    // standard deviation of the path length after one metre, m
  double angular_per_metre = 0;   // standard deviation of the heading after one metre, rad
  double angular_per_radian = 0;  // standard deviation of the heading after one radian, rad

  bool is_none() const { return *this == OdometryDrift{}; }
  friend bool operator==(const OdometryDrift&, const OdometryDrift&) = default;
};

// Reads the parameters. Reports invalid ones to the reader.
OdometryDrift ReadOdometryDrift(ParameterReader& reader);

// A step of a robot's motion: the distance `way` in m, and the change of heading `turn` in rad.
struct OdometryStep {
  double way = 0, turn = 0;
};
// Returns the odometry's estimate of the exact step. `first`, `second` and `third` are standard
// normal numbers.
OdometryStep Drifted(const OdometryDrift& drift, OdometryStep exact, double first, double second,
                     double third);

// The position that drifting odometry has estimated.
class DriftState final : public world::DeviceState {
 public:
  DriftState(world::DeviceMount mount, const OdometryDrift& drift)
      : DeviceState(std::move(mount)), drift_(drift) {}

  void AddToHash(base::Hash& hash) const override;
  world::DeviceStatePtr BeforeStep(world::DeviceStep& step) const override;
  world::DeviceStatePtr CarryOver(const world::Layout& layout,
                                  const std::vector<std::string>& placed,
                                  base::SimTime now) const override;

  // Returns the estimate after the motion since the last step.
  geometry::PlanarPosition EstimateAt(const world::Snapshot& now, int body,
                                      std::uint64_t seed) const;

 private:
  const OdometryDrift drift_;  // the parameters of the sensor
  // True position at the last step; nullopt before the first step.
  std::optional<geometry::PlanarPosition> exact_;
  geometry::PlanarPosition estimate_;  // the estimate at the last step
};

}  // namespace gsv::sensing
