#include "gsv/sensing/devices/bumper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "gsv/geometry/distance.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/model/collision_names.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

// A contact is with the ground if the z component of its normal is below this value. The normal is
// then within about 45 degrees of downwards.
constexpr double kGroundSlope = -0.70;
constexpr double kNormalLength = 0.3;  // m
// A contact point belongs to two collisions if the point's distances from them differ by less than
// this (m).
constexpr double kSamePlace = 1e-3;

readings::Vector ToVector(const Vector3& v) { return {v.x, v.y, v.z}; }
Vector3 FromVector(const readings::Vector& v) { return {v.x, v.y, v.z}; }

// Finds the contacts of the collisions that a bumper names. An engine reports the bodies of a
// contact, and not their collisions. So a contact counts if no other collision of the robot is
// nearer to the contact point than a named collision.
class NamedCollisions {
 public:
  NamedCollisions(const model::SensorDescription& sensor, std::vector<std::string> names)
      : link_(sensor.link), names_(std::move(names)) {}

  bool Touch(const world::Snapshot& snapshot, int body, const Vector3& point_in_world) const {
    if (names_.empty()) return true;
    const model::Model& model = *snapshot.layout->bodies[static_cast<std::size_t>(body)].model;
    const std::vector<geometry::Pose> world_from_link = world::LinkPoses(snapshot, body);
    const auto distance_to = [&](int link, const model::Collision& collision) {
      const geometry::Pose world_from_collision =
          world_from_link[static_cast<std::size_t>(link)] * collision.link_from_collision;
      return geometry::DistanceTo(collision.shape, Inverse(world_from_collision) * point_in_world);
    };
    double nearest_named = std::numeric_limits<double>::infinity();
    for (const std::string& name : names_) {
      const auto found = model::FindCollision(model, link_, name);
      if (!found) continue;
      const auto& collisions = model.links[static_cast<std::size_t>(found->link)].collisions;
      nearest_named = std::min(
          nearest_named,
          distance_to(found->link, collisions[static_cast<std::size_t>(found->collision)]));
    }
    if (!std::isfinite(nearest_named)) return false;
    for (std::size_t link = 0; link < model.links.size(); ++link) {
      for (const model::Collision& collision : model.links[link].collisions) {
        const double distance = distance_to(static_cast<int>(link), collision);
        if (distance < nearest_named - kSamePlace) return false;
      }
    }
    return true;
  }

 private:
  const int link_;
  const std::vector<std::string> names_;
};

class Bumper final : public SensorOf<readings::Contact, messages::gsv_msgs::Bumper> {
 public:
  Bumper(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        half_view_(reader.Number("field_of_view", 2 * std::numbers::pi, 0, 2 * std::numbers::pi) /
                   2),
        // By default, a bumper with named collisions, such as feet, also reports the ground.
        feels_ground_(reader.Flag("ground", !model::CollisionNamesOf(description).empty())),
        collisions_(description, NamesIn(description, reader)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    Values felt;
    for (const world::Contact& contact : sampling.snapshot()->contacts) {
      const bool is_of_robot =
          contact.first == sampling.body() || contact.second == sampling.body();
      if (!is_of_robot || (contact.supports && !feels_ground_)) continue;
      AddTouches(sampling, contact, felt);
    }
    Reading reading = sampling.Stamped();
    Fill(felt, reading);
    return reading;
  }

 private:
  void AddTouches(const Sampling& sampling, const world::Contact& contact, Values& felt) const {
    const world::Snapshot& snapshot = *sampling.snapshot();
    const geometry::Pose sensor_from_world = Inverse(sampling.WorldFromSensor(description()));
    const bool is_first = contact.first == sampling.body();
    for (const world::ContactPoint& at : world::PointsOf(contact)) {
      const Vector3 outwards = is_first ? at.normal : -at.normal;
      if (!feels_ground_ && outwards.z < kGroundSlope) continue;
      if (!collisions_.Touch(snapshot, sampling.body(), at.point)) continue;
      const Vector3 point = sensor_from_world * at.point;
      if (std::abs(std::atan2(point.y, point.x)) > half_view_) continue;
      felt.touches.push_back(
          {.other = snapshot.layout->bodies[is_first ? contact.second : contact.first].name,
           .point = ToVector(point),
           .normal = ToVector(sensor_from_world.orientation * outwards),
           .depth = at.depth,
           .closing_speed = contact.closing_speed,
           .force = ToVector(sensor_from_world.orientation *
                             ((is_first ? -1.0 : 1.0) * world::MeanForce(snapshot, at.impulse)))});
    }
  }

  static std::vector<std::string> NamesIn(const model::SensorDescription& description,
                                          ParameterReader& reader) {
    (void)reader.Text(model::kCollisionNames, "");  // this call rejects a value that is not text
    return model::CollisionNamesOf(description);
  }

  Message ToMessage(const Values& felt, const Reading&, const std::string&) const override {
    Message message;
    for (const readings::Touch& touch : felt.touches) {
      const auto& [point, normal, force] = std::tie(touch.point, touch.normal, touch.force);
      message.contacts.push_back({touch.other,
                                  {point.x, point.y, point.z},
                                  {normal.x, normal.y, normal.z},
                                  touch.depth,
                                  touch.closing_speed,
                                  {force.x, force.y, force.z}});
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
  const NamedCollisions collisions_;
};

}  // namespace

SensorType BumperType() {
  return MakeSensorType<Bumper>(readings::Contact::kType, {"bumper"}, Overlay::kLines);
}

}  // namespace gsv::sensing
