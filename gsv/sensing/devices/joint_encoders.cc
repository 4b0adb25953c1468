#include "gsv/sensing/devices/joint_encoders.h"

#include <cmath>
#include <numbers>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

bool Moves(const model::Joint& joint) {
  return joint.kind == model::JointKind::kRevolute || joint.kind == model::JointKind::kContinuous ||
         joint.kind == model::JointKind::kPrismatic;
}

class JointEncoders final : public Sensor {
 public:
  JointEncoders(const model::SensorDescription& description, ParameterReader& reader)
      : Sensor(description),
        joint_(reader.Text("joint", "")),
        counts_per_turn_(reader.Number("counts_per_turn", 0, 0, 1e9)),
        position_noise_(ReadNoise(reader, "position.noise", 1e3)),
        velocity_noise_(ReadNoise(reader, "velocity.noise", 1e3)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::State& state = sampling.snapshot()->state;
    const world::Body& robot = sampling.robot();
    const NoisyReading noisy(sampling, description());
    Reading reading = sampling.Stamped();
    auto labels = std::make_shared<std::vector<std::string>>();
    for (std::size_t j = 0; j < robot.model->joints.size(); ++j) {
      const model::Joint& joint = robot.model->joints[j];
      if (!Moves(joint) || (!joint_.empty() && joint.name != joint_)) continue;
      const std::size_t place = robot.first_joint + j;
      const double position = noisy.Read(position_noise_, 2 * j, state.joint_positions[place]);
      reading.values.push_back(Counted(position));
      reading.values.push_back(
          noisy.Read(velocity_noise_, 2 * j + 1, state.joint_velocities[place]));
      labels->push_back(joint.name);
    }
    if (!joint_.empty() && labels->empty()) {
      return base::Fail(base::ErrorCode::kNotFound,
                        "the robot has no joint \"" + joint_ + "\" that moves",
                        robot.name + "/" + description().name);
    }
    reading.labels = std::move(labels);
    return reading;
  }

  static messages::sensor_msgs::JointState ToMessage(const model::SensorDescription&,
                                                     const Reading& reading, const std::string&) {
    messages::sensor_msgs::JointState message;
    for (std::size_t i = 0; reading.labels != nullptr && i < reading.labels->size(); ++i) {
      message.name.push_back((*reading.labels)[i]);
      message.position.push_back(reading.values[2 * i]);
      message.velocity.push_back(reading.values[2 * i + 1]);
    }
    return message;
  }

 private:
  double Counted(double position) const {
    if (counts_per_turn_ == 0) return position;
    const double count = 2 * std::numbers::pi / counts_per_turn_;
    return count * std::floor(position / count);
  }

  const std::string joint_;  // empty: all
  const double counts_per_turn_;
  const NoiseModel position_noise_, velocity_noise_;
};

}  // namespace

SensorType JointEncodersType() {
  return MakeSensorType<JointEncoders, messages::sensor_msgs::JointState>("joint_encoders",
                                                                          {"joint_state"});
}

}  // namespace gsv::sensing
