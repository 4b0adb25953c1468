#include "gsv/sensing/devices/navsat.h"

#include <array>
#include <numbers>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/devices/geodesy.h"
#include "gsv/sensing/devices/sensor_motion.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

constexpr double kDegrees = 180 / std::numbers::pi;

class Navsat final : public SensorOf<readings::Navsat, messages::sensor_msgs::NavSatFix> {
 public:
  Navsat(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        across_(ReadNoise(reader, "position_sensing.horizontal.noise", 1e6)),
        up_(ReadNoise(reader, "position_sensing.vertical.noise", 1e6)),
        velocity_across_(ReadNoise(reader, "velocity_sensing.horizontal.noise", 1e6)),
        velocity_up_(ReadNoise(reader, "velocity_sensing.vertical.noise", 1e6)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const auto& origin = sampling.snapshot()->layout->description->origin;
    if (!origin) {
      return base::Fail(
          base::ErrorCode::kUnavailable,
          "the world has no <spherical_coordinates>, so its position on the earth is unknown",
          sampling.robot().name + "/" + description().name);
    }
    const SensorMotion motion = MotionOf(sampling, description());
    const NoisyReading noisy(sampling, description());
    // Errors are added in metres, before the position is converted to angles.
    const Vector3& p = motion.world_from_sensor.position;
    const Vector3 point{noisy.Read(across_, 0, p.x), noisy.Read(across_, 1, p.y),
                        noisy.Read(up_, 2, p.z)};
    const GeodeticPlace place = PlaceOf(*origin, point);
    const Vector3 velocity = EastNorthUp(*origin, motion.velocity);
    Reading reading = sampling.Stamped();
    Fill(Values{.latitude_deg = place.latitude * kDegrees,
                .longitude_deg = place.longitude * kDegrees,
                .altitude = place.altitude,
                .east = noisy.Read(velocity_across_, 3, velocity.x),
                .north = noisy.Read(velocity_across_, 4, velocity.y),
                .up = noisy.Read(velocity_up_, 5, velocity.z)},
         reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& fix, const Reading&, const std::string&) const override {
    Message message;
    message.latitude = fix.latitude_deg;
    message.longitude = fix.longitude_deg;
    message.altitude = fix.altitude;
    message.status.service = messages::sensor_msgs::NavSatStatus::kServiceGps;
    const double across = across_.stddev, up = up_.stddev;
    message.position_covariance = {across * across, 0, 0, 0, across * across, 0, 0, 0, up * up};
    message.position_covariance_type = Message::kCovarianceTypeDiagonalKnown;
    return message;
  }

  const NoiseModel across_, up_, velocity_across_, velocity_up_;
};

}  // namespace

SensorType NavsatType() { return MakeSensorType<Navsat>(readings::Navsat::kType, {"gps", "gnss"}); }

}  // namespace gsv::sensing
