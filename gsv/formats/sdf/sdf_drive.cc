#include "gsv/formats/sdf/sdf_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gsv/formats/sdf/sdf_document.h"
#include "gsv/model/drive_choice.h"
#include "gsv/model/drive_guess.h"

namespace gsv::formats {
namespace {

using geometry::Vector3;
using model::Drive;
using model::DriveKind;
using model::Joint;
using model::Model;

std::optional<DriveKind> KindOf(const std::string& file_name, const std::string& name) {
  struct Known {
    const char* part;
    DriveKind kind;
  };
  // The known drives. The text is a part of the plugin's file name or class name, in lower case,
  // without "-" and "_".
  static constexpr Known known[] = {
      {"diffdrive", DriveKind::kDifferential},      {"skidsteerdrive", DriveKind::kDifferential},
      {"ackermannsteering", DriveKind::kAckermann}, {"ackermanndrive", DriveKind::kAckermann},
      {"mecanumdrive", DriveKind::kMecanum},        {"velocitycontrol", DriveKind::kVelocity},
      {"planarmove", DriveKind::kVelocity},         {"synchrodrive", DriveKind::kSynchro},
      {"trackedvehicle", DriveKind::kDifferential},
  };
  for (const std::string& text : {file_name, name}) {
    std::string plain;
    for (const char c : text) {
      if (c != '-' && c != '_')
        plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    for (const Known& candidate : known) {
      if (plain.find(candidate.part) != std::string::npos) return candidate.kind;
    }
  }
  return std::nullopt;
}

class DriveReader {
 public:
  DriveReader(const sdf::ElementPtr& plugin, const Model& model, const std::string& scope,
              const ReadingContext& context)
      : plugin_(plugin), model_(model), scope_(scope), context_(context) {}

  std::optional<Drive> Read(DriveKind kind) {
    drive_.kind = kind;
    drive_.left_wheels =
        Joints({"left_joint", "leftJoint", "left_front", "left_rear", "leftFrontJoint",
                "leftRearJoint", "front_left_joint", "back_left_joint", "rear_left_joint"});
    drive_.right_wheels =
        Joints({"right_joint", "rightJoint", "right_front", "right_rear", "rightFrontJoint",
                "rightRearJoint", "front_right_joint", "back_right_joint", "rear_right_joint"});
    if (kind == DriveKind::kAckermann) {
      drive_.steered = Joints({"left_steering_joint", "right_steering_joint"});
    }
    if (kind == DriveKind::kSynchro) drive_.left_wheels = Joints({"wheel_joint"});
    const bool paired = kind == DriveKind::kDifferential || kind == DriveKind::kAckermann ||
                        kind == DriveKind::kMecanum;
    const bool has_sides = !drive_.left_wheels.empty() && !drive_.right_wheels.empty();
    // Tracks are surfaces of links and have no joints, so joints may be missing then.
    const bool has_tracks = plugin_->HasElement("tracks_separation");
    if (!is_complete_ || (paired && !has_sides && !has_tracks)) return GuessInstead();
    ReadSizes();
    if (kind == DriveKind::kAckermann && !(drive_.wheel_base > 0)) {
      context_.Warn("the drive needs front and rear wheels to determine its wheel base", Place());
      return GuessInstead();
    }
    ReadLimits();
    return drive_;
  }

 private:
  std::string Place() const { return PlaceOf(*plugin_, context_.source); }

  bool OnlySteers() const {
    return drive_.kind == DriveKind::kAckermann && plugin_->HasElement("steering_only") &&
           plugin_->Get<bool>("steering_only");
  }

  Drive GuessInstead() {
    const bool only_steers = is_complete_ && OnlySteers();
    const bool has_sides = !drive_.left_wheels.empty() && !drive_.right_wheels.empty();
    if (is_complete_ && !only_steers && !has_sides) {
      context_.Warn("the drive names no joint of a left and of a right wheel", Place());
    }
    drive_ = model::GuessDrive(model_);
    if (drive_.kind != DriveKind::kNone) ReadLimits();
    if (only_steers && drive_.kind == DriveKind::kNone) return drive_;
    Model robot = model_;
    robot.drive = drive_;
    context_.Warn(std::string(only_steers ? "the plugin only steers" : "the plugin is not used") +
                      "; the drive is " + model::DescribeDrive(robot),
                  Place());
    return drive_;
  }

  std::vector<int> Joints(std::initializer_list<const char*> element_names) {
    std::vector<int> joints;
    for (const char* element_name : element_names) {
      if (!plugin_->HasElement(element_name)) continue;
      for (auto element = plugin_->GetElement(element_name); element != nullptr;
           element = element->GetNextElement(element_name)) {
        const std::string name = scope_ + element->Get<std::string>();
        const auto it = std::find_if(model_.joints.begin(), model_.joints.end(),
                                     [&](const Joint& joint) { return joint.name == name; });
        if (it != model_.joints.end()) {
          joints.push_back(static_cast<int>(it - model_.joints.begin()));
          continue;
        }
        is_complete_ = false;
        context_.Warn("the drive names the joint \"" + name + "\", which the model does not have",
                      Place());
      }
    }
    return joints;
  }

  std::optional<double> Number(std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      if (!plugin_->HasElement(name)) continue;
      const auto text = plugin_->Get<std::string>(name);
      char* end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (end != text.c_str() && std::isfinite(value)) return value;
      context_.Warn(std::string("<") + name + "> must be a number, not \"" + text +
                        "\"; it is ignored, as if it were missing",
                    Place());
    }
    return std::nullopt;
  }

  double Positive(std::initializer_list<const char*> names, double otherwise) const {
    const auto value = Number(names);
    if (!value) return otherwise;
    if (*value > 0) return *value;
    context_.Warn(std::string("<") + *names.begin() +
                      "> must be above zero; it is ignored, as if it were missing",
                  Place());
    return otherwise;
  }

  void ReadSizes() {
    drive_.wheel_separation = Positive({"wheel_separation", "wheelSeparation", "tracks_separation"},
                                       MeasuredSeparation());
    const auto diameter = Number({"wheel_diameter", "wheelDiameter"});
    drive_.wheel_radius = diameter && *diameter > 0
                              ? *diameter / 2
                              : Positive({"wheel_radius", "wheelRadius"}, MeasuredRadius());
    // Two parameters of GSV, for wheels whose radius differs from the radius that the drive
    // assumes.
    drive_.left_wheel_scale =
        Positive({"left_wheel_radius"}, drive_.wheel_radius) / drive_.wheel_radius;
    drive_.right_wheel_scale =
        Positive({"right_wheel_radius"}, drive_.wheel_radius) / drive_.wheel_radius;
    drive_.wheel_base = Positive({"wheel_base", "wheelbase"}, MeasuredWheelBase());
    drive_.steering_limit = Positive({"steering_limit", "max_steer"}, drive_.steering_limit);
  }

  // Returns a limit in both directions. If there is only a maximum, it also applies backwards, as
  // in Gazebo.
  model::Range Limits(const std::string& what) const {
    model::Range range;
    const auto max = Number({("max_" + what).c_str()});
    const auto min = Number({("min_" + what).c_str()});
    if (max) range = {-std::abs(*max), std::abs(*max)};
    if (min) range.min = *min;
    if (range.min > range.max || range.max < 0 || range.min > 0) {
      context_.Warn("the limits of " + what + " must include zero; they are ignored", Place());
      return {};
    }
    return range;
  }

  static model::Range OrElse(const model::Range& range, const model::Range& otherwise) {
    return std::isinf(range.min) && std::isinf(range.max) ? otherwise : range;
  }

  void ReadLimits() {
    drive_.linear_velocity = OrElse(Limits("linear_velocity"), Limits("velocity"));
    drive_.angular_velocity = Limits("angular_velocity");
    drive_.linear_acceleration =
        OrElse(OrElse(Limits("linear_acceleration"), Limits("acceleration")),
               Limits("wheel_acceleration"));
    drive_.angular_acceleration = Limits("angular_acceleration");
    if (const auto timeout = Number({"command_timeout"}); timeout && *timeout > 0) {
      drive_.command_timeout =
          base::SimTime(static_cast<std::int64_t>(std::llround(std::min(*timeout, 1e6) * 1e9)));
    }
  }

  const Joint& JointAt(int index) const { return model_.joints[static_cast<std::size_t>(index)]; }

  // Returns the origin of the wheel's first collision shape, or of its joint if the wheel has none.
  Vector3 WheelCentre(int joint) const {
    const model::Link& wheel = model_.links[static_cast<std::size_t>(JointAt(joint).child)];
    if (wheel.collisions.empty()) return JointAt(joint).model_from_joint.position;
    return (wheel.model_from_link * wheel.collisions.front().link_from_collision).position;
  }

  Vector3 MeanCentre(const std::vector<int>& joints) const {
    Vector3 sum;
    for (const int joint : joints) sum += WheelCentre(joint);
    return sum * (1.0 / static_cast<double>(std::max<std::size_t>(joints.size(), 1)));
  }

  double MeasuredSeparation() const {
    if (drive_.left_wheels.empty() || drive_.right_wheels.empty()) return drive_.wheel_separation;
    const Vector3 apart = MeanCentre(drive_.left_wheels) - MeanCentre(drive_.right_wheels);
    const double distance = std::hypot(apart.x, apart.y);
    return distance > 0 ? distance : drive_.wheel_separation;
  }

  double MeasuredRadius() const {
    for (const auto* wheels : {&drive_.left_wheels, &drive_.right_wheels}) {
      for (const int joint : *wheels) {
        const model::Link& wheel = model_.links[static_cast<std::size_t>(JointAt(joint).child)];
        for (const model::Collision& collision : wheel.collisions) {
          if (const auto radius = RadiusOf(collision.shape)) return *radius;
        }
      }
    }
    return drive_.wheel_radius;
  }

  static std::optional<double> RadiusOf(const geometry::Shape& shape) {
    if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape)) return cylinder->radius;
    if (const auto* sphere = std::get_if<geometry::Sphere>(&shape)) return sphere->radius;
    if (const auto* capsule = std::get_if<geometry::Capsule>(&shape)) return capsule->radius;
    if (const auto* ellipsoid = std::get_if<geometry::Ellipsoid>(&shape)) {
      return std::max({ellipsoid->radii.x, ellipsoid->radii.y, ellipsoid->radii.z});
    }
    if (const auto* mesh = std::get_if<geometry::Mesh>(&shape)) {
      const geometry::Bounds bounds = geometry::BoundsOf(shape);
      const Vector3 size = bounds.max - bounds.min;
      // The largest side of a wheel's bounding box is its diameter.
      return mesh->triangles->triangles.empty()
                 ? std::nullopt
                 : std::optional(std::max({size.x, size.y, size.z}) / 2);
    }
    return std::nullopt;
  }

  // Returns the distance from the front wheel to the rear wheel in metres.
  double MeasuredWheelBase() const {
    double front = -std::numeric_limits<double>::infinity();
    double rear = std::numeric_limits<double>::infinity();
    for (const auto* wheels : {&drive_.left_wheels, &drive_.right_wheels}) {
      for (const int joint : *wheels) {
        front = std::max(front, WheelCentre(joint).x);
        rear = std::min(rear, WheelCentre(joint).x);
      }
    }
    return front > rear ? front - rear : 0;
  }

  sdf::ElementPtr plugin_;
  const Model& model_;
  const std::string& scope_;
  const ReadingContext& context_;
  Drive drive_;
  bool is_complete_ = true;
};

}  // namespace

std::optional<Drive> ReadDrive(const sdf::ElementPtr& plugin, const Model& model,
                               const std::string& scope, const ReadingContext& context) {
  const auto kind = KindOf(plugin->Get<std::string>("filename", "").first,
                           plugin->Get<std::string>("name", "").first);
  if (!kind) return std::nullopt;
  return DriveReader(plugin, model, scope, context).Read(*kind);
}

}  // namespace gsv::formats
