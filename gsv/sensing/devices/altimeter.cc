#include "gsv/sensing/devices/altimeter.h"

#include <cmath>
#include <limits>

#include "gsv/messages/ros_gz_interfaces.h"
#include "gsv/sensing/devices/sensor_motion.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

class Altimeter final : public Sensor {
 public:
  Altimeter(const model::SensorDescription& description, ParameterReader& reader)
      : Sensor(description),
        reference_(reader.Number("vertical_reference", std::numeric_limits<double>::quiet_NaN(),
                                 -1e6, 1e6)),
        position_noise_(ReadNoise(reader, "vertical_position.noise", 1e6)),
        velocity_noise_(ReadNoise(reader, "vertical_velocity.noise", 1e6)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const SensorMotion motion = MotionOf(sampling, description());
    const double reference = std::isnan(reference_) ? Start(sampling.robot()) : reference_;
    const NoisyReading noisy(sampling, description());
    Reading reading = sampling.Stamped();
    reading.values = {
        noisy.Read(position_noise_, 0, motion.world_from_sensor.position.z - reference),
        noisy.Read(velocity_noise_, 1, motion.velocity.z), reference};
    return reading;
  }

  static messages::ros_gz_interfaces::Altimeter ToMessage(const model::SensorDescription&,
                                                          const Reading& reading,
                                                          const std::string&) {
    messages::ros_gz_interfaces::Altimeter message;
    if (reading.values.size() == 3) {
      message.vertical_position = reading.values[0];
      message.vertical_velocity = reading.values[1];
      message.vertical_reference = reading.values[2];
    }
    return message;
  }

 private:
  double Start(const world::Body& robot) const {
    const geometry::Pose model_from_sensor =
        robot.model->links[description().link].model_from_link * description().link_from_sensor;
    return (robot.initial_pose * model_from_sensor).position.z;
  }

  const double reference_;  // NaN: where it starts
  const NoiseModel position_noise_, velocity_noise_;
};

}  // namespace

SensorType AltimeterType() {
  return MakeSensorType<Altimeter, messages::ros_gz_interfaces::Altimeter>("altimeter");
}

}  // namespace gsv::sensing
