#include "gsv/sensing/devices/odometer.h"

#include <cmath>
#include <optional>
#include <string_view>

#include "gsv/messages/nav_msgs.h"
#include "gsv/sensing/device.h"
#include "gsv/sensing/devices/odometry_drift.h"
#include "gsv/sensing/frames.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

// Returns the name of the robot in a frame name "ROBOT/SENSOR".
std::string_view RobotOf(std::string_view frame) { return frame.substr(0, frame.rfind('/')); }

using OdometryMessage = messages::nav_msgs::Odometry;

OdometryMessage MessageOf(const readings::Odometry& estimate, const Reading& reading,
                          const std::string& frame_id) {
  OdometryMessage message;
  message.header = HeaderOf(reading, FrameOf(RobotOf(frame_id), kOdometryFrame));
  message.child_frame_id = FrameOf(RobotOf(frame_id), kBaseFrame);
  const geometry::Pose pose = geometry::PlanarPose(estimate.x, estimate.y, 0, estimate.yaw);
  message.pose.pose.position = {estimate.x, estimate.y, 0};
  message.pose.pose.orientation = {0, 0, pose.orientation.z, pose.orientation.w};
  message.twist.twist.linear.x = estimate.linear;
  message.twist.twist.linear.y = estimate.lateral;
  message.twist.twist.angular.z = estimate.angular;
  return message;
}

class VelocityNoise {
 public:
  explicit VelocityNoise(ParameterReader& reader)
      : linear_(ReadNoise(reader, "linear.noise", 1e3)),
        angular_(ReadNoise(reader, "angular.noise", 1e3)) {}

  // Returns the reading for the position `place`. The true velocities are multiplied by the scales.
  readings::Odometry Read(const Sampling& sampling, const model::SensorDescription& description,
                          const geometry::PlanarPosition& place, double linear_scale = 1,
                          double angular_scale = 1) const {
    const NoisyReading noisy(sampling, description);
    const world::BodyState& body = sampling.snapshot()->state.bodies[sampling.body()];
    const double linear = linear_scale * body.odometry.linear,
                 angular = angular_scale * body.odometry.angular;
    // The lateral velocity of a base that cannot move sideways is 0, and gets no noise.
    const double lateral = linear_scale * body.drive.actual.lateral;
    return {.x = place.x,
            .y = place.y,
            .yaw = std::atan2(place.sine, place.cosine),
            .linear = noisy.Read(linear_, 0, linear),
            .angular = noisy.Read(angular_, 1, angular),
            .lateral = lateral == 0 ? 0 : noisy.Read(linear_, 2, lateral)};
  }

 private:
  const NoiseModel linear_, angular_;
};

class Odometer final : public SensorOf<readings::Odometry, OdometryMessage> {
 public:
  Odometer(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description), noise_(reader) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::Odometry& odometry = sampling.snapshot()->state.bodies[sampling.body()].odometry;
    Reading reading = sampling.Stamped();
    Fill(noise_.Read(sampling, description(), odometry.place), reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& estimate, const Reading& reading,
                    const std::string& frame_id) const override {
    return MessageOf(estimate, reading, frame_id);
  }

  const VelocityNoise noise_;
};

// An odometer whose errors accumulate. Its state is the estimated pose.
class DriftingOdometer final : public SensorOf<readings::Odometry, OdometryMessage, Device> {
 public:
  DriftingOdometer(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description), noise_(reader), drift_(ReadOdometryDrift(reader)) {}

  std::optional<world::DeviceCommand> first() const override { return world::DeviceCommand{}; }
  base::Status Check(const world::DeviceCommand&) const override {
    return Refuse("an odometer accepts no commands");
  }
  world::DeviceStatePtr Apply(const std::string& robot, const world::DeviceStatePtr& before,
                              const world::DeviceCommand&, world::DeviceStep&) const override {
    if (before != nullptr) return before;
    return std::make_shared<const DriftState>(MountOn(robot), drift_);
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::Odometry& odometry = sampling.snapshot()->state.bodies[sampling.body()].odometry;
    const auto* const state = dynamic_cast<const DriftState*>(StateIn(sampling));
    const geometry::PlanarPosition place =
        state != nullptr ? state->EstimateAt(*sampling.snapshot(), sampling.body(), sampling.seed())
                         : odometry.place;
    Reading reading = sampling.Stamped();
    Fill(noise_.Read(sampling, description(), place, drift_.linear_scale, drift_.angular_scale),
         reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& estimate, const Reading& reading,
                    const std::string& frame_id) const override {
    return MessageOf(estimate, reading, frame_id);
  }

  const VelocityNoise noise_;
  const OdometryDrift drift_;
};

bool Drifts(const model::SensorDescription& description) {
  const auto whole = WithPreset(readings::Odometry::kType, description);
  if (!whole) return false;
  ParameterReader reader(*whole);
  return !ReadOdometryDrift(reader).is_none();
}

}  // namespace

SensorType OdometerType() {
  auto type = MakeSensorType<Odometer>(readings::Odometry::kType, {"wheel_odometry"});
  const auto drifting = MakeSensorType<DriftingOdometer>(readings::Odometry::kType);
  type.create = [exact = type.create, drifting = drifting.create](const auto& description) {
    return Drifts(description) ? drifting(description) : exact(description);
  };
  return type;
}

}  // namespace gsv::sensing
