// A robot, a piece of furniture, a building: links held together by joints.
//
// Frames  each link's pose is given in the model's frame at zero joint positions. Nested models
//         are flattened by the reader; their parts are named "inner::link".
// Sharing one Model is read once and placed many times; it is immutable once built.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/geometry/shape.h"
#include "gsv/model/control_system.h"
#include "gsv/model/drive.h"
#include "gsv/model/material.h"
#include "gsv/model/sensor_description.h"

namespace gsv::model {

struct Visual {
  std::string name;
  geometry::Pose link_from_visual;
  geometry::Shape shape;
  // One for each material slot of a mesh; a shape that is not a mesh uses the first. Never empty.
  std::vector<Material> materials{Material{}};
  bool cast_shadows = true;
  std::optional<double> temperature = std::nullopt;  // K; without one it is as warm as the air
};

// Coulomb friction and restitution, as in SDFormat's <surface>.
struct Surface {
  double friction = 1.0;   // along friction_direction
  double friction2 = 1.0;  // across
  double restitution = 0.0;
  // In the collision's frame, unit length; zero: the world's x axis.
  geometry::Vector3 friction_direction;
};

struct Collision {
  std::string name;
  geometry::Pose link_from_collision;
  geometry::Shape shape;
  Surface surface;
};

struct Inertial {
  double mass = 1.0;             // kg
  geometry::Pose link_from_com;  // principal frame of the inertia below
  // Moments and products of inertia about the centre of mass, kg m².
  double ixx = 1, iyy = 1, izz = 1, ixy = 0, ixz = 0, iyz = 0;
};

struct Link {
  std::string name;
  geometry::Pose model_from_link;
  Inertial inertial;
  std::vector<Visual> visuals;
  std::vector<Collision> collisions;
  bool has_gravity = true;
};

enum class JointKind {
  kFixed,
  kRevolute,
  kContinuous,
  kPrismatic,
  kBall,   // one of three in a row that are one ball joint, see SplitJoint() in gsv/formats
  kScrew,  // turns, and slides by thread_pitch times the angle
};

// What can be told to a joint of one scalar: to be somewhere, to move so fast, to be pushed so
// hard.
inline bool TakesCommands(JointKind kind) {
  return kind != JointKind::kFixed && kind != JointKind::kBall;
}

struct Joint {
  std::string name;
  JointKind kind = JointKind::kFixed;
  int parent = -1;  // link index; -1: the world
  int child = 0;    // link index
  // The joint's frame in the model at zero position; the child turns about or slides along `axis`.
  geometry::Pose model_from_joint;
  geometry::Vector3 axis{0, 0, 1};  // unit length, in the joint's frame
  Range position_limits;
  double effort_limit = std::numeric_limits<double>::infinity();  // N or N m
  double velocity_limit = std::numeric_limits<double>::infinity();
  double damping = 0;
  double friction = 0;
  double thread_pitch = 0;  // m/rad, of kScrew
};

// "revolute", "prismatic", …
const char* NameOf(JointKind kind);

// The index of the joint of that name that takes commands, or -1.
int FindJoint(const std::vector<Joint>& joints, const std::string& name);

// What a joint is told to do from the start, by its model's own controllers.
struct JointTarget {
  enum class Kind { kPosition, kVelocity };  // rad or m; rad/s or m/s
  int joint = 0;                             // index in Model::joints
  Kind kind = Kind::kPosition;
  double value = 0;
};

// What moves a model with a drive.
enum class Movement {
  kPlanar,  // its drive alone, over level ground
  kRigid,   // forces: its wheels roll, it climbs, tips, is pushed
};

struct Script;  // gsv/model/script.h

struct Model {
  std::string name;    // as the file says
  std::string source;  // the file it was read from, for messages
  bool is_static = false;
  // Where its file puts it in a world when whoever places it says nothing.
  geometry::Pose default_pose;
  std::vector<Link> links;                 // links[0] is the canonical link; never empty
  std::vector<Joint> joints;               // a forest: no link is the child of two joints
  std::vector<JointTarget> joint_targets;  // at most one of a joint
  std::vector<SensorDescription> sensors;
  std::vector<ControlSystem> control_systems;
  std::optional<Drive> drive;             // present: a robot that can be given a behaviour
  Movement movement = Movement::kPlanar;  // of a model with a drive
  std::shared_ptr<const Script> script;   // of an actor, which it moves; null: the model is none
};

// The radius about the model's origin, in its xy plane, of a circle that holds the boxes around
// all collisions (a Plane counts for nothing).
double FootprintRadius(const Model& model);

// The lowest z, in the model's frame, of the boxes around all collisions (a Plane counts for
// nothing); 0 without any. Exact for boxes; for round shapes that lie askew it is a lower bound.
double LowestPoint(const Model& model);
// The same of the model when it is turned, below its origin.
double LowestPoint(const Model& model, const geometry::Quaternion& world_from_model);

}  // namespace gsv::model
