#include "gsv/sensing/devices/bumper.h"

#include <cmath>
#include <numbers>

#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

constexpr std::size_t kValuesOfContact = 8;  // of one contact
constexpr double kGroundSlope = -0.70;       // of a normal that points down within 45 degrees
constexpr double kNormalLength = 0.3;        // m

class Bumper final : public Sensor {
 public:
  Bumper(const model::SensorDescription& description, ParameterReader& reader)
      : Sensor(description),
        half_view_(reader.Number("field_of_view", 2 * std::numbers::pi, 0, 2 * std::numbers::pi) /
                   2),
        feels_ground_(reader.Flag("ground", false)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::Snapshot& snapshot = *sampling.snapshot();
    const geometry::Pose sensor_from_world = Inverse(sampling.WorldFromSensor(description()));
    Reading reading = sampling.Stamped();
    auto labels = std::make_shared<std::vector<std::string>>();
    for (const world::Contact& contact : snapshot.contacts) {
      const bool is_first = contact.first == sampling.body();
      if (!is_first && contact.second != sampling.body()) continue;
      const Vector3 outwards = is_first ? contact.normal : -contact.normal;
      if (!feels_ground_ && outwards.z < kGroundSlope) continue;
      const Vector3 point = sensor_from_world * contact.point;
      if (std::abs(std::atan2(point.y, point.x)) > half_view_) continue;
      const Vector3 normal = sensor_from_world.orientation * outwards;
      for (const double value : {point.x, point.y, point.z, normal.x, normal.y, normal.z,
                                 contact.depth, contact.closing_speed}) {
        reading.values.push_back(value);
      }
      labels->push_back(snapshot.layout->bodies[is_first ? contact.second : contact.first].name);
    }
    reading.labels = std::move(labels);
    return reading;
  }

  static messages::gsv_msgs::Bumper ToMessage(const model::SensorDescription&,
                                              const Reading& reading, const std::string&) {
    messages::gsv_msgs::Bumper message;
    for (std::size_t i = 0; reading.labels != nullptr && i < reading.labels->size(); ++i) {
      const double* const v = &reading.values[kValuesOfContact * i];
      message.contacts.push_back(
          {(*reading.labels)[i], {v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6], v[7]});
    }
    return message;
  }

 private:
  const double half_view_;
  const bool feels_ground_;
};

std::vector<Segment> ContactLines(const model::SensorDescription&, const Reading& reading) {
  std::vector<Segment> lines;
  for (std::size_t i = 0; i + kValuesOfContact <= reading.values.size(); i += kValuesOfContact) {
    const double* const v = &reading.values[i];
    const Vector3 point{v[0], v[1], v[2]};
    lines.push_back({point, point - kNormalLength * Vector3{v[3], v[4], v[5]}});
  }
  return lines;
}

}  // namespace

SensorType BumperType() {
  SensorType type = MakeSensorType<Bumper, messages::gsv_msgs::Bumper>("contact", {"bumper"});
  type.overlay = Overlay::kLines;
  type.beams = ContactLines;
  return type;
}

}  // namespace gsv::sensing
