#include "gsv/sensing/devices/orientation_reference.h"

#include <cmath>
#include <numbers>

namespace gsv::sensing {
namespace {

using geometry::Quaternion;
using geometry::Vector3;

std::string NameOfParameter(const char* name) {
  return std::string("orientation_reference_frame.") + name;
}

// The rotation from the world to a frame whose x axis is `along_x` and whose z axis is `z`. Both
// vectors must have length 1 and be at right angles to each other.
Quaternion QuaternionToFrame(const Vector3& along_x, const Vector3& z) {
  // The shortest rotation from z to (0, 0, 1). If z points straight down, this is half a turn about
  // x.
  const bool is_below = z.z < -1 + 1e-12;
  const Quaternion upright =
      is_below ? Quaternion{0, 1, 0, 0} : geometry::Normalized({1 + z.z, z.y, -z.x, 0});
  const Vector3 x = upright * along_x;
  return geometry::FromAxisAngle({0, 0, 1}, -std::atan2(x.y, x.x)) * upright;
}

}  // namespace

OrientationReference::OrientationReference(ParameterReader& reader) {
  const std::string name = reader.Text(NameOfParameter("localization"), "CUSTOM");
  if (name == "ENU") {
    kind_ = Kind::kEnu;
  } else if (name == "NED") {
    kind_ = Kind::kNed;
  } else if (name == "NWU") {
    kind_ = Kind::kNwu;
  } else if (name == "GRAV_UP") {
    kind_ = Kind::kGravityUp;
  } else if (name == "GRAV_DOWN") {
    kind_ = Kind::kGravityDown;
  } else if (name != "CUSTOM") {
    reader.Refuse(NameOfParameter("localization") +
                  " must be CUSTOM, ENU, NED, NWU, GRAV_UP or GRAV_DOWN, not \"" + name + "\"");
  }
  const Vector3 rpy = reader.Triple(NameOfParameter("custom_rpy"), {}, -1e3, 1e3);
  if (kind_ == Kind::kCustom && !(rpy == Vector3{})) {
    is_world_ = false;
    custom_from_world_ = Inverse(geometry::FromRollPitchYaw({rpy.x, rpy.y, rpy.z}));
  }
  if (kind_ != Kind::kCustom) is_world_ = false;
  along_x_ = reader.Triple(NameOfParameter("grav_dir_x"), along_x_, -1e9, 1e9);
}

Quaternion OrientationReference::AlongGravity(const Vector3& gravity) const {
  if (!(geometry::Norm(gravity) > 0)) return {};
  const Vector3 down = geometry::Normalized(gravity);
  const Vector3 z = kind_ == Kind::kGravityUp ? -down : down;
  Vector3 level = along_x_ - Dot(along_x_, z) * z;
  // `along_x` is parallel to gravity, so any direction is valid
  if (!(geometry::Norm(level) > 1e-9)) {
    const Vector3 other = std::abs(z.x) < 0.5 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
    level = other - Dot(other, z) * z;
  }
  return QuaternionToFrame(geometry::Normalized(level), z);
}

Quaternion OrientationReference::ReferenceFromWorld(const model::WorldDescription& world) const {
  const auto turned = [&](double by) {
    const double heading = world.origin ? world.origin->heading : 0;
    return geometry::FromAxisAngle({0, 0, 1}, heading + by);
  };
  switch (kind_) {
    case Kind::kCustom:
      return custom_from_world_;
    case Kind::kEnu:
      return turned(0);
    case Kind::kNwu:
      return turned(-std::numbers::pi / 2);
    case Kind::kNed:  // x and y of ENU are exchanged, and z points down
      return Quaternion{0, std::sqrt(0.5), std::sqrt(0.5), 0} * turned(0);
    case Kind::kGravityUp:
    case Kind::kGravityDown:
      return AlongGravity(world.gravity);
  }
  return {};
}

}  // namespace gsv::sensing
