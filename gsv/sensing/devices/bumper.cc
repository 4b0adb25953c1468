#include "gsv/sensing/devices/bumper.h"

#include <cmath>
#include <numbers>

#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

constexpr double kGroundSlope = -0.70;  // of a normal that points down within 45 degrees
constexpr double kNormalLength = 0.3;   // m

readings::Vector ToVector(const Vector3& v) { return {v.x, v.y, v.z}; }
Vector3 FromVector(const readings::Vector& v) { return {v.x, v.y, v.z}; }

class Bumper final : public SensorOf<readings::Contact, messages::gsv_msgs::Bumper> {
 public:
  Bumper(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        half_view_(reader.Number("field_of_view", 2 * std::numbers::pi, 0, 2 * std::numbers::pi) /
                   2),
        feels_ground_(reader.Flag("ground", false)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::Snapshot& snapshot = *sampling.snapshot();
    const geometry::Pose sensor_from_world = Inverse(sampling.WorldFromSensor(description()));
    Values felt;
    for (const world::Contact& contact : snapshot.contacts) {
      const bool is_first = contact.first == sampling.body();
      if (!is_first && contact.second != sampling.body()) continue;
      const Vector3 outwards = is_first ? contact.normal : -contact.normal;
      if (!feels_ground_ && outwards.z < kGroundSlope) continue;
      const Vector3 point = sensor_from_world * contact.point;
      if (std::abs(std::atan2(point.y, point.x)) > half_view_) continue;
      const Vector3 normal = sensor_from_world.orientation * outwards;
      felt.touches.push_back(
          {.other = snapshot.layout->bodies[is_first ? contact.second : contact.first].name,
           .point = ToVector(point),
           .normal = ToVector(normal),
           .depth = contact.depth,
           .closing_speed = contact.closing_speed});
    }
    Reading reading = sampling.Stamped();
    Fill(felt, reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& felt, const Reading&, const std::string&) const override {
    Message message;
    for (const readings::Touch& touch : felt.touches) {
      const auto& [point, normal] = std::tie(touch.point, touch.normal);
      message.contacts.push_back({touch.other,
                                  {point.x, point.y, point.z},
                                  {normal.x, normal.y, normal.z},
                                  touch.depth,
                                  touch.closing_speed});
    }
    return message;
  }

  std::vector<Segment> BeamsOf(const Values& felt) const override {
    std::vector<Segment> lines;
    for (const readings::Touch& touch : felt.touches) {
      const Vector3 point = FromVector(touch.point);
      lines.push_back({point, point - kNormalLength * FromVector(touch.normal)});
    }
    return lines;
  }

  const double half_view_;
  const bool feels_ground_;
};

}  // namespace

SensorType BumperType() {
  return MakeSensorType<Bumper>(readings::Contact::kType, {"bumper"}, Overlay::kLines);
}

}  // namespace gsv::sensing
