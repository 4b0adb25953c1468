#include "gsv/sensing/devices/positioning.h"

#include <numbers>

#include "gsv/messages/geometry_msgs.h"
#include "gsv/sensing/frames.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

class Positioning final
    : public SensorOf<readings::Positioning, messages::geometry_msgs::PoseStamped> {
 public:
  Positioning(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        position_stddev_(reader.Number("noise.position.stddev", 0, 0, 1e3)),
        orientation_stddev_(reader.Number("noise.orientation.stddev", 0, 0, std::numbers::pi)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const geometry::Pose pose = sampling.WorldFromSensor(description());
    const geometry::RollPitchYaw angles = geometry::ToRollPitchYaw(pose.orientation);
    readings::Placement place{pose.position.x, pose.position.y, pose.position.z,
                              angles.roll,     angles.pitch,    angles.yaw};
    base::Noise noise = sampling.NoiseOf(description());
    if (position_stddev_ > 0) {
      for (double* const part : {&place.x, &place.y, &place.z}) {
        *part += position_stddev_ * noise.Gaussian();
      }
    }
    if (orientation_stddev_ > 0) {
      place.yaw = geometry::WrapAngle(place.yaw + orientation_stddev_ * noise.Gaussian());
    }
    Reading reading = sampling.Stamped();
    Fill(Values{place}, reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& measured, const Reading& reading,
                    const std::string&) const override {
    const readings::Placement& p = measured.world_from_sensor;
    const geometry::Quaternion q = geometry::FromRollPitchYaw({p.roll, p.pitch, p.yaw});
    Message message;
    message.header = HeaderOf(reading, std::string(kWorldFrame));
    message.pose.position = {p.x, p.y, p.z};
    message.pose.orientation = {q.x, q.y, q.z, q.w};
    return message;
  }

  const double position_stddev_, orientation_stddev_;
};

}  // namespace

SensorType PositioningType() { return MakeSensorType<Positioning>(readings::Positioning::kType); }

}  // namespace gsv::sensing
