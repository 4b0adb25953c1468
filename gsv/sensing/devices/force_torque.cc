#include "gsv/sensing/devices/force_torque.h"

#include <array>

#include "gsv/messages/geometry_msgs.h"
#include "gsv/sensing/devices/joint_wrench.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Quaternion;
using geometry::Vector3;

constexpr double kDrawnPerNewton = 0.01;  // length of the drawn line, m per N

class ForceTorque final
    : public SensorOf<readings::ForceTorque, messages::geometry_msgs::WrenchStamped> {
 public:
  ForceTorque(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        frame_(reader.Text("frame", "child")),
        direction_(reader.Text("measure_direction", "child_to_parent")) {
    if (frame_ != "child" && frame_ != "parent" && frame_ != "sensor") {
      reader.Refuse("frame must be child, parent or sensor, not \"" + frame_ + "\"");
    }
    if (direction_ != "child_to_parent" && direction_ != "parent_to_child") {
      reader.Refuse("measure_direction must be child_to_parent or parent_to_child, not \"" +
                    direction_ + "\"");
    }
    constexpr std::array kAxes = {"x", "y", "z"};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string axis = kAxes[i];
      noise_[i] = ReadNoise(reader, "force." + axis + ".noise", 1e9);
      noise_[i + 3] = ReadNoise(reader, "torque." + axis + ".noise", 1e9);
    }
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const model::Model& model = *sampling.robot().model;
    const int joint = JointAbove(model, description().link);
    if (joint < 0) {
      return base::Fail(base::ErrorCode::kNotFound,
                        "the sensor's link has no parent joint; put a force_torque sensor into "
                        "the <joint> that it measures",
                        sampling.robot().name + "/" + description().name);
    }
    const JointWrench wrench = WrenchOf(*sampling.snapshot(), sampling.body(), joint);
    const double sign = direction_ == "parent_to_child" ? 1 : -1;
    const Quaternion frame_from_world = Inverse(WorldFromFrame(sampling, joint));
    const NoisyReading noisy(sampling, description());
    const auto measured = [&](const Vector3& in_world, std::size_t channel) {
      const Vector3 v = frame_from_world * (sign * in_world);
      return readings::Vector{noisy.Read(noise_[channel], channel, v.x),
                              noisy.Read(noise_[channel + 1], channel + 1, v.y),
                              noisy.Read(noise_[channel + 2], channel + 2, v.z)};
    };
    Reading reading = sampling.Stamped();
    Fill(Values{measured(wrench.force, 0), measured(wrench.torque, 3)}, reading);
    return reading;
  }

 private:
  Quaternion WorldFromFrame(const Sampling& sampling, int joint) const {
    const model::Joint& of = sampling.robot().model->joints[static_cast<std::size_t>(joint)];
    if (frame_ == "sensor") return sampling.WorldFromSensor(description()).orientation;
    const int link = frame_ == "parent" ? of.parent : of.child;
    if (link < 0) return {};  // the world
    return world::LinkPose(*sampling.snapshot(), sampling.body(), link).orientation;
  }

  Message ToMessage(const Values& values, const Reading&, const std::string&) const override {
    Message message;
    message.wrench.force = {values.force.x, values.force.y, values.force.z};
    message.wrench.torque = {values.torque.x, values.torque.y, values.torque.z};
    return message;
  }

  // Returns lines only for the sensor's frame, because the axes of the other frames are not known
  // here.
  std::vector<Segment> BeamsOf(const Values& values) const override {
    if (!description().visualize || frame_ != "sensor") return {};
    return {{{}, kDrawnPerNewton * Vector3{values.force.x, values.force.y, values.force.z}}};
  }

  const std::string frame_, direction_;
  std::array<NoiseModel, 6> noise_;
};

}  // namespace

SensorType ForceTorqueType() {
  return MakeSensorType<ForceTorque>(readings::ForceTorque::kType, {"forcetorque"},
                                     Overlay::kLines);
}

}  // namespace gsv::sensing
