// A model, such as a robot, furniture or a building: links connected by joints.
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
#include "gsv/model/collision_filter.h"
#include "gsv/model/control_system.h"
#include "gsv/model/drive.h"
#include "gsv/model/material.h"
#include "gsv/model/sensor_description.h"

namespace gsv::model {

struct Visual {
  std::string name;
  geometry::Pose link_from_visual;
  geometry::Shape shape;
  // One per material slot of a mesh; other shapes use the first. Never empty.
  std::vector<Material> materials{Material{}};
  bool cast_shadows = true;
  std::optional<double> temperature = std::nullopt;  // in K; nullopt: that of the air
};

// A wheel that slips, as Gazebo's WheelSlip describes it: the normal force is a constant, so that
// slip is proportional to the friction force.
struct SlippingWheel {
  Slip slip;
  double normal_force = 0;  // > 0, N
  double radius = 0;        // > 0, m
};

// Coulomb friction, slip and restitution, as in SDFormat's <surface>.
struct Surface {
  double friction = 1.0;   // along friction_direction
  double friction2 = 1.0;  // friction across that direction
  double restitution = 0.0;
  // in the collision's frame, of unit length; zero for the world's x axis
  geometry::Vector3 friction_direction;
  // Velocity at which the surfaces slide on each other, per friction force, m/(s N): <slip1> and
  // <slip2>, along and across friction_direction.
  double slip = 0, slip2 = 0;
  // Soft ground: the slip of wheels that roll on this surface, in addition to their own.
  Slip wheel_slip;
  CollisionFilter filter;
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
  bool has_wind = false;  // whether the wind of the world pushes it
  // whether it moves only by its drive or the command of its joint, and not by forces
  bool is_kinematic = false;
  // The fraction of its velocity that it loses in each step of the world's length, in [0, 1]:
  // SDFormat's <velocity_decay>, as Gazebo applies it with ODE.
  double linear_decay = 0, angular_decay = 0;
  // For a wheel: it slips if it has a slip of its own, or rolls on soft ground. Its axle is the axis
  // of the joint above it.
  std::optional<SlippingWheel> wheel = std::nullopt;
};

enum class JointKind {
  kFixed,
  kRevolute,
  kContinuous,
  kPrismatic,
  // one of three consecutive joints that form a ball joint, see SplitJoint() in gsv/formats
  kBall,
  kScrew,  // rotates, and slides by thread_pitch times the angle
};

// Whether a joint takes commands: a position, a velocity or an effort.
inline bool TakesCommands(JointKind kind) {
  return kind != JointKind::kFixed && kind != JointKind::kBall;
}

// A joint that follows another one, as gears do: its position is multiplier * (leader - reference) +
// offset. With rigid-body dynamics the leader feels the reaction.
struct Mimic {
  int leader = 0;  // index in Model::joints
  double multiplier = 1, offset = 0, reference = 0;
};

// The gains of a PID controller, as gz::math::PID has them: effort = p e + i ∫e dt + d de/dt, where
// e is the command minus the measured value.
struct JointGains {
  double p = 1, i = 0, d = 0;
  Range integral{-1, 1};      // limits of the term i ∫e dt, N m or N
  Range effort{-1000, 1000};  // limits of the sum; effort_limit applies as well
  double offset = 0;          // added to the sum, N m or N
};

struct Joint {
  std::string name;
  JointKind kind = JointKind::kFixed;
  int parent = -1;  // index of the parent link; -1: the world
  int child = 0;    // link index
  // The joint's frame in the model at zero position. The child rotates about or slides along
  // `axis`.
  geometry::Pose model_from_joint;
  geometry::Vector3 axis{0, 0, 1};  // unit length, in the joint's frame
  Range position_limits;
  double effort_limit = std::numeric_limits<double>::infinity();  // in N or N m
  double velocity_limit = std::numeric_limits<double>::infinity();
  double damping = 0;
  double friction = 0;
  double thread_pitch = 0;  // in m/rad, for kScrew
  std::optional<Mimic> mimic = std::nullopt;
  // How commands of a position and of a velocity are followed with rigid-body dynamics (default: as
  // fast as the joint's limits allow).
  std::optional<JointGains> position_gains = std::nullopt, velocity_gains = std::nullopt;
};

// "revolute", "prismatic", …
const char* NameOf(JointKind kind);

// Returns the index of the joint with that name that accepts commands, or -1.
int FindJoint(const std::vector<Joint>& joints, const std::string& name);

// An initial command of a joint, from the model's own controllers.
struct JointTarget {
  enum class Kind { kPosition, kVelocity, kEffort };  // rad or m; rad/s or m/s; N m or N
  int joint = 0;                                      // index of the joint in Model::joints
  Kind kind = Kind::kPosition;
  double value = 0;
};

// The movement of a model with a drive.
enum class Movement {
  kPlanar,  // planar kinematics on level ground
  kRigid,   // rigid-body dynamics: its wheels roll, it climbs, tips and is pushed
};

struct Script;  // gsv/model/script.h

struct Model {
  std::string name;    // the name in the file
  std::string source;  // the file from which it was read, for messages
  bool is_static = false;
  // The pose in the file, used in a world if no other pose is given.
  geometry::Pose default_pose;
  std::vector<Link> links;    // links[0] is the canonical link; never empty
  std::vector<Joint> joints;  // a forest: no link is the child of two joints
  // Joints that close loops of links: each holds two links of the forest together, with rigid-body
  // dynamics only. Such a joint has no position in a state, no commands, limits or losses. Its kind
  // is fixed, revolute, continuous, prismatic or ball.
  std::vector<Joint> loop_joints;
  std::vector<JointTarget> joint_targets;  // at most one per joint
  std::vector<double> start_positions;     // initial positions of the joints; empty: all zero
  std::vector<SensorDescription> sensors;
  std::vector<ControlSystem> control_systems;
  std::optional<Drive> drive;             // set for a robot that can be given a behaviour
  Movement movement = Movement::kPlanar;  // for a model with a drive
  std::shared_ptr<const Script> script;   // for an actor, else null
};

// Returns the radius about the model's origin, in its xy plane, of a circle that contains the boxes
// around all collisions except planes.
double FootprintRadius(const Model& model);

// Returns the lowest z, in the model's frame, of the boxes around all collisions except planes; 0
// if there are none. Exact for boxes; a lower bound for tilted round shapes.
double LowestPoint(const Model& model);
// Returns the lowest z relative to the origin, for a rotated model.
double LowestPoint(const Model& model, const geometry::Quaternion& world_from_model);

}  // namespace gsv::model
