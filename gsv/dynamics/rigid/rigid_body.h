// The constant description of a body for rigid-body dynamics: its parts, their shapes and surfaces.
// It lives as long as the layout.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gsv/dynamics/motion/articulation.h"
#include "gsv/dynamics/motion/drive_kinematics.h"
#include "gsv/dynamics/motion/medium_forces.h"
#include "gsv/dynamics/motion/wheel_slip.h"
#include "gsv/dynamics/rigid/matrix3.h"
#include "gsv/model/model.h"

class btCollisionShape;

namespace gsv::dynamics {

class TriangleSurface;

// A shape of a solid, used to find contacts.
struct Piece {
  enum class Kind : std::uint8_t { kSphere, kBox, kCylinder, kCapsule, kPlane, kMesh, kOther };
  Kind kind = Kind::kOther;
  geometry::Pose solid_from_piece;  // pose of the piece's frame in the frame of its solid
  Matrix3 rotation;                 // rotation of solid_from_piece
  // m, in the piece's frame. Box: half of its sides. Cylinder: (radius, radius, half length).
  // Sphere and capsule: (radius, radius, half of the distance between the centres of its ends).
  geometry::Vector3 half;
  geometry::Vector3 normal;           // normal of a plane, which passes through the piece's origin
  geometry::Vector3 middle, box;      // centre of its bounding box, and half of its size
  btCollisionShape* shape = nullptr;  // never null
  const TriangleSurface* triangles = nullptr;  // null except for a static mesh
  model::Surface surface;                      // friction, slip and restitution
};

// A collision shape with its surface properties.
struct Solid {
  int body = 0;  // index in the layout
  std::vector<Piece> pieces;
  // half of the smallest extent of its thinnest piece, if that is less than 1 m
  double thickness = 1;
  double radius = 0;                  // radius about the origin of the shape's frame
  std::optional<RollingWheel> wheel;  // set for a part that rolls

  // Whether a surface of the solid has a restitution above 0.
  bool bounces() const;
};

// A body that rigid-body dynamics moves.
struct RigidBody {
  int body = 0;  // index in the layout
  const model::Model* model = nullptr;
  Articulation articulation;
  std::vector<Solid> solids;      // the solids of its parts
  std::vector<PartMedium> media;  // one for each part; empty if no medium exerts a force
  std::optional<DriveKinematics> kinematics;  // nullopt if the body has no drive
  int first_joint = 0;                        // index of the body's first joint in the state
  // Whether the body has parts that joints connect.
  bool is_jointed() const { return articulation.parts.size() > 1; }
};

}  // namespace gsv::dynamics
