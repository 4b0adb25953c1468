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

class Odometer final : public Sensor {
 public:
  Odometer(const model::SensorDescription& description, ParameterReader& reader)
      : Sensor(description),
        linear_noise_(ReadNoise(reader, "linear.noise", 1e3)),
        angular_noise_(ReadNoise(reader, "angular.noise", 1e3)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::Odometry& odometry = sampling.snapshot()->state.bodies[sampling.body()].odometry;
    const NoisyReading noisy(sampling, description());
    Reading reading = sampling.Stamped();
    reading.values = {odometry.place.x, odometry.place.y,
                      std::atan2(odometry.place.sine, odometry.place.cosine),
                      noisy.Read(linear_noise_, 0, odometry.linear),
                      noisy.Read(angular_noise_, 1, odometry.angular)};
    return reading;
  }

  static messages::nav_msgs::Odometry ToMessage(const model::SensorDescription&,
                                                const Reading& reading,
                                                const std::string& frame_id) {
    messages::nav_msgs::Odometry message;
    message.child_frame_id = FrameOf(RobotOf(frame_id), kBaseFrame);
    const auto& v = reading.values;
    if (v.size() != 5) return message;
    const geometry::Pose pose = geometry::PlanarPose(v[0], v[1], 0, v[2]);
    message.pose.pose.position = {v[0], v[1], 0};
    message.pose.pose.orientation = {0, 0, pose.orientation.z, pose.orientation.w};
    message.twist.twist.linear.x = v[3];
    message.twist.twist.angular.z = v[4];
    return message;
  }

 private:
  const NoiseModel linear_noise_, angular_noise_;
};

}  // namespace

SensorType OdometerType() {
  SensorType type =
      MakeSensorType<Odometer, messages::nav_msgs::Odometry>("odometry", {"wheel_odometry"});
  type.encode = [](const model::SensorDescription& description, const Reading& reading,
                   const std::string& frame_id) {
    auto message = Odometer::ToMessage(description, reading, frame_id);
    message.header = HeaderOf(reading, FrameOf(RobotOf(frame_id), kOdometryFrame));
    return Encoded(message);
  };
  return type;
}

}  // namespace gsv::sensing
