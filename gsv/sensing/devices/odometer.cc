#include "gsv/sensing/devices/odometer.h"

#include <cmath>
#include <string_view>

#include "gsv/messages/nav_msgs.h"
#include "gsv/sensing/frames.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

// From "ROBOT/SENSOR".
std::string_view RobotOf(std::string_view frame) { return frame.substr(0, frame.rfind('/')); }

class Odometer final : public SensorOf<readings::Odometry, messages::nav_msgs::Odometry> {
 public:
  Odometer(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        linear_noise_(ReadNoise(reader, "linear.noise", 1e3)),
        angular_noise_(ReadNoise(reader, "angular.noise", 1e3)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::BodyState& body = sampling.snapshot()->state.bodies[sampling.body()];
    const world::Odometry& odometry = body.odometry;
    const NoisyReading noisy(sampling, description());
    // Of a base that cannot move sideways it is 0, and stays so.
    const double lateral = body.drive.actual.lateral;
    Reading reading = sampling.Stamped();
    Fill(Values{.x = odometry.place.x,
                .y = odometry.place.y,
                .yaw = std::atan2(odometry.place.sine, odometry.place.cosine),
                .linear = noisy.Read(linear_noise_, 0, odometry.linear),
                .angular = noisy.Read(angular_noise_, 1, odometry.angular),
                .lateral = lateral == 0 ? 0 : noisy.Read(linear_noise_, 2, lateral)},
         reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& estimate, const Reading& reading,
                    const std::string& frame_id) const override {
    Message message;
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

  const NoiseModel linear_noise_, angular_noise_;
};

}  // namespace

SensorType OdometerType() {
  return MakeSensorType<Odometer>(readings::Odometry::kType, {"wheel_odometry"});
}

}  // namespace gsv::sensing
