#include "gsv/sensing/devices/altimeter.h"

#include <cmath>
#include <limits>

#include "gsv/messages/ros_gz_interfaces.h"
#include "gsv/sensing/devices/sensor_motion.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

class Altimeter final
    : public SensorOf<readings::Altimeter, messages::ros_gz_interfaces::Altimeter> {
 public:
  Altimeter(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        reference_(reader.Number("vertical_reference", std::numeric_limits<double>::quiet_NaN(),
                                 -1e6, 1e6)),
        position_noise_(ReadNoise(reader, "vertical_position.noise", 1e6)),
        velocity_noise_(ReadNoise(reader, "vertical_velocity.noise", 1e6)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const SensorMotion motion = MotionOf(sampling, description());
    const double reference = std::isnan(reference_) ? Start(sampling.robot()) : reference_;
    const NoisyReading noisy(sampling, description());
    Reading reading = sampling.Stamped();
    Fill(Values{.position =
                    noisy.Read(position_noise_, 0, motion.world_from_sensor.position.z - reference),
                .velocity = noisy.Read(velocity_noise_, 1, motion.velocity.z),
                .reference = reference},
         reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& height, const Reading&, const std::string&) const override {
    Message message;
    message.vertical_position = height.position;
    message.vertical_velocity = height.velocity;
    message.vertical_reference = height.reference;
    return message;
  }

  double Start(const world::Body& robot) const {
    const model::Model& model = *robot.model;
    const auto link = static_cast<std::size_t>(description().link);
    const geometry::Pose model_from_link =
        model.start_positions.empty() ? model.links[link].model_from_link
                                      : world::LinkPoses(model, model.start_positions)[link];
    return (robot.initial_pose * model_from_link * description().link_from_sensor).position.z;
  }

  const double reference_;  // NaN if the reference is the initial height
  const NoiseModel position_noise_, velocity_noise_;
};

}  // namespace

SensorType AltimeterType() { return MakeSensorType<Altimeter>(readings::Altimeter::kType); }

}  // namespace gsv::sensing
