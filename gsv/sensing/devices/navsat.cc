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

class Navsat final : public Sensor {
 public:
  Navsat(const model::SensorDescription& description, ParameterReader& reader)
      : Sensor(description),
        across_(ReadNoise(reader, "position_sensing.horizontal.noise", 1e6)),
        up_(ReadNoise(reader, "position_sensing.vertical.noise", 1e6)),
        velocity_across_(ReadNoise(reader, "velocity_sensing.horizontal.noise", 1e6)),
        velocity_up_(ReadNoise(reader, "velocity_sensing.vertical.noise", 1e6)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const auto& origin = sampling.snapshot()->layout->description->origin;
    if (!origin) {
      return base::Fail(base::ErrorCode::kUnavailable,
                        "the world has no <spherical_coordinates>, so that satellites cannot tell "
                        "where it is",
                        sampling.robot().name + "/" + description().name);
    }
    const SensorMotion motion = MotionOf(sampling, description());
    const NoisyReading noisy(sampling, description());
    // Errors are made in metres, before these become angles.
    const Vector3& p = motion.world_from_sensor.position;
    const Vector3 point{noisy.Read(across_, 0, p.x), noisy.Read(across_, 1, p.y),
                        noisy.Read(up_, 2, p.z)};
    const GeodeticPlace place = PlaceOf(*origin, point);
    const Vector3 velocity = EastNorthUp(*origin, motion.velocity);
    Reading reading = sampling.Stamped();
    reading.values = {place.latitude * kDegrees,
                      place.longitude * kDegrees,
                      place.altitude,
                      noisy.Read(velocity_across_, 3, velocity.x),
                      noisy.Read(velocity_across_, 4, velocity.y),
                      noisy.Read(velocity_up_, 5, velocity.z)};
    return reading;
  }

  static messages::sensor_msgs::NavSatFix ToMessage(const model::SensorDescription& description,
                                                    const Reading& reading, const std::string&) {
    messages::sensor_msgs::NavSatFix message;
    if (reading.values.size() != 6) return message;
    message.latitude = reading.values[0];
    message.longitude = reading.values[1];
    message.altitude = reading.values[2];
    message.status.service = messages::sensor_msgs::NavSatStatus::kServiceGps;
    const double across =
        model::NumberOr(description.parameters, "position_sensing.horizontal.noise.stddev", 0);
    const double up =
        model::NumberOr(description.parameters, "position_sensing.vertical.noise.stddev", 0);
    message.position_covariance = {across * across, 0, 0, 0, across * across, 0, 0, 0, up * up};
    message.position_covariance_type =
        messages::sensor_msgs::NavSatFix::kCovarianceTypeDiagonalKnown;
    return message;
  }

 private:
  const NoiseModel across_, up_, velocity_across_, velocity_up_;
};

}  // namespace

SensorType NavsatType() {
  return MakeSensorType<Navsat, messages::sensor_msgs::NavSatFix>("navsat", {"gps", "gnss"});
}

}  // namespace gsv::sensing
