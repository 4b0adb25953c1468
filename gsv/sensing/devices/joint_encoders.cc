#include "gsv/sensing/devices/joint_encoders.h"

#include <cmath>
#include <numbers>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

// Whether the joint has one position: an angle, or for prismatic joints a length. The position of a
// screw joint is its angle.
bool HasPosition(const model::Joint& joint) {
  using enum model::JointKind;
  return joint.kind == kRevolute || joint.kind == kContinuous || joint.kind == kPrismatic ||
         joint.kind == kScrew;
}

class JointEncoders final
    : public SensorOf<readings::JointEncoders, messages::sensor_msgs::JointState> {
 public:
  JointEncoders(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        joint_(reader.Text("joint", "")),
        counts_per_turn_(reader.Number("counts_per_turn", 0, 0, 1e9)),
        position_noise_(ReadNoise(reader, "position.noise", 1e3)),
        velocity_noise_(ReadNoise(reader, "velocity.noise", 1e3)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::State& state = sampling.snapshot()->state;
    const world::Body& robot = sampling.robot();
    const NoisyReading noisy(sampling, description());
    Values encoded;
    for (std::size_t j = 0; j < robot.model->joints.size(); ++j) {
      const model::Joint& joint = robot.model->joints[j];
      if (!HasPosition(joint) || (!joint_.empty() && joint.name != joint_)) continue;
      const std::size_t place = robot.first_joint + j;
      const double position = noisy.Read(position_noise_, 2 * j, state.joint_positions[place]);
      encoded.joints.push_back(
          {.name = joint.name,
           .position = Counted(position),
           .velocity = noisy.Read(velocity_noise_, 2 * j + 1, state.joint_velocities[place])});
    }
    if (!joint_.empty() && encoded.joints.empty()) {
      return base::Fail(base::ErrorCode::kNotFound,
                        "the robot has no joint \"" + joint_ + "\" that moves",
                        robot.name + "/" + description().name);
    }
    Reading reading = sampling.Stamped();
    Fill(encoded, reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& encoded, const Reading&, const std::string&) const override {
    Message message;
    for (const readings::EncodedJoint& joint : encoded.joints) {
      message.name.push_back(joint.name);
      message.position.push_back(joint.position);
      message.velocity.push_back(joint.velocity);
    }
    return message;
  }

  double Counted(double position) const {
    if (counts_per_turn_ == 0) return position;
    const double count = 2 * std::numbers::pi / counts_per_turn_;
    return count * std::floor(position / count);
  }

  const std::string joint_;  // empty for all joints
  const double counts_per_turn_;
  const NoiseModel position_noise_, velocity_noise_;
};

}  // namespace

SensorType JointEncodersType() {
  return MakeSensorType<JointEncoders>(readings::JointEncoders::kType, {"joint_state"});
}

}  // namespace gsv::sensing
