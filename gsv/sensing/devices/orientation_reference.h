// The frame in which an IMU returns its orientation: SDFormat's <orientation_reference_frame>.
#pragma once

#include <string>

#include "gsv/model/world_description.h"
#include "gsv/sensing/parameters.h"

namespace gsv::sensing {

// The reference frame of an orientation. East, north and up are the directions at the world's
// position on the earth. The world's x points east, rotated by the heading of
// <spherical_coordinates> (default: 0).
class OrientationReference {
 public:
  // Reads the parameters orientation_reference_frame.localization (default: the world's frame),
  // .custom_rpy and .grav_dir_x. The values of custom_rpy and grav_dir_x are in the world's frame.
  explicit OrientationReference(ParameterReader& reader);

  // Whether the reference frame is the world's frame itself.
  bool is_world() const { return is_world_; }
  // The rotation of vectors from the world's frame to the reference frame.
  geometry::Quaternion ReferenceFromWorld(const model::WorldDescription& world) const;

 private:
  // Returns the rotation to the frame GRAV_UP or GRAV_DOWN.
  geometry::Quaternion AlongGravity(const geometry::Vector3& gravity) const;

  enum class Kind { kCustom, kEnu, kNed, kNwu, kGravityUp, kGravityDown };
  Kind kind_ = Kind::kCustom;               // where the axes of the reference frame point
  bool is_world_ = true;                    // see is_world()
  geometry::Quaternion custom_from_world_;  // only for kCustom
  // for GRAV_UP and GRAV_DOWN: x points along the horizontal part of this vector
  geometry::Vector3 along_x_{1, 0, 0};
};

}  // namespace gsv::sensing
