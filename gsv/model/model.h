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

// A shape of a link that is drawn.
struct Visual {
  std::string name;
  geometry::Pose link_from_visual;
  geometry::Shape shape;
  // One material for each material slot of a mesh. Other shapes use the first material. Never
  // empty.
  std::vector<Material> materials{Material{}};
  bool cast_shadows = true;
  std::optional<double> temperature = std::nullopt;  // in K; nullopt: the temperature of the air
};

// A wheel that slips, as in Gazebo's WheelSlip: the normal force is a constant, so that slip is
// proportional to the friction force.
struct SlippingWheel {
  Slip slip;
  double normal_force = 0;  // > 0, N
  double radius = 0;        // > 0, m
};

// Coulomb friction, slip and restitution, as in SDFormat's <surface>.
struct Surface {
  double friction = 1.0;     // along friction_direction
  double friction2 = 1.0;    // friction coefficient across friction_direction
  double restitution = 0.0;  // 0: no rebound, 1: rebound with the speed of the impact
  // Unit vector in the collision's frame; zero for the world's x axis.
  geometry::Vector3 friction_direction;
  // Velocity at which the surfaces slide on each other, per friction force, m/(s N): <slip1> and
  // <slip2>, along and across friction_direction.
  double slip = 0, slip2 = 0;
  // Soft ground: this slip is added to the slip of wheels that roll on the surface.
  Slip wheel_slip;
  CollisionFilter filter;  // which other surfaces the surface can touch
};

// A collision shape of a link, with its surface.
struct Collision {
  std::string name;
  geometry::Pose link_from_collision;
  geometry::Shape shape;
  Surface surface;
};

// The mass, the centre of mass and the inertia of a link.
struct Inertial {
  double mass = 1.0;             // kg
  geometry::Pose link_from_com;  // pose of the frame in which the moments below are given
  // Moments and products of inertia about the centre of mass, kg m².
  double ixx = 1, iyy = 1, izz = 1, ixy = 0, ixz = 0, iyz = 0;
};

// A rigid part of a model.
struct Link {
  std::string name;
  geometry::Pose model_from_link;
  Inertial inertial;
  std::vector<Visual> visuals;
  std::vector<Collision> collisions;
  bool has_gravity = true;
  bool has_wind = false;  // whether wind pushes the link
  // Whether only the drive or the command of its joint moves the link, and forces do not.
  bool is_kinematic = false;
  // The fraction of its velocity that the link loses in a time of the world's max_step_size, in
  // [0, 1]: SDFormat's <velocity_decay>, as Gazebo applies it with ODE.
  double linear_decay = 0, angular_decay = 0;
  // Set if the link is a wheel that has its own slip or may roll on soft ground. The wheel's axle
  // is the axis of the joint whose child is this link.
  std::optional<SlippingWheel> wheel = std::nullopt;
};

// The motion that a joint allows.
enum class JointKind {
  kFixed,
  kRevolute,
  kContinuous,
  kPrismatic,
  // One of three consecutive joints that together form a ball joint, see AddJoint() in
  // gsv/formats/sdf/sdf_joint.cc.
  kBall,
  kScrew,  // rotates, and slides by thread_pitch times the rotation
};

// Whether joints of this kind accept commands: a position, a velocity or an effort.
inline bool TakesCommands(JointKind kind) {
  return kind != JointKind::kFixed && kind != JointKind::kBall;
}

// A joint that follows another joint, as gears do: its position is multiplier * (leader -
// reference) + offset. With rigid-body dynamics, the reaction acts on the leader.
struct Mimic {
  int leader = 0;  // index in Model::joints
  double multiplier = 1, offset = 0, reference = 0;
};

// The gains of a PID controller, as in gz::math::PID: effort = p e + i ∫e dt + d de/dt, where e is
// the command minus the measured value.
struct JointGains {
  double p = 1, i = 0, d = 0;
  Range integral{-1, 1};      // limits of the term i ∫e dt, N m or N
  Range effort{-1000, 1000};  // limits of the sum of all terms; effort_limit also applies
  double offset = 0;          // added to the sum, N m or N
};

// A joint between two links, or between a link and the world.
struct Joint {
  std::string name;
  JointKind kind = JointKind::kFixed;
  int parent = -1;  // index of the parent link; -1 for the world
  int child = 0;    // index of the child link
  // The joint's frame in the model at zero position. The child rotates about or slides along
  // `axis`.
  geometry::Pose model_from_joint;
  geometry::Vector3 axis{0, 0, 1};  // unit length, in the joint's frame
  Range position_limits;            // rad or m, relative to zero position
  double effort_limit = std::numeric_limits<double>::infinity();    // in N or N m
  double velocity_limit = std::numeric_limits<double>::infinity();  // rad/s or m/s
  double damping = 0;       // N m s/rad or N s/m: force per velocity
  double friction = 0;      // N m or N: constant force against the motion
  double thread_pitch = 0;  // in m/rad, for kScrew
  std::optional<Mimic> mimic = std::nullopt;
  // The controllers that follow position and velocity commands with rigid-body dynamics (default:
  // as fast as the joint's limits allow).
  std::optional<JointGains> position_gains = std::nullopt, velocity_gains = std::nullopt;
};

// Returns "revolute", "prismatic", …
const char* NameOf(JointKind kind);

// Returns the index of the joint with that name if the joint accepts commands, else -1.
int FindJoint(const std::vector<Joint>& joints, const std::string& name);

// An initial command of a joint, from the model's own controllers.
struct JointTarget {
  enum class Kind {
    kPosition,  // rad or m
    kVelocity,  // rad/s or m/s
    kEffort     // N m or N
  };
  int joint = 0;  // index of the joint in Model::joints
  Kind kind = Kind::kPosition;
  double value = 0;  // in the unit of the kind
};

// The method that moves a model with a drive.
enum class Movement {
  kPlanar,  // planar kinematics on level ground
  kRigid,   // rigid-body dynamics: wheels roll, and the model can climb, tip over and be pushed
};

struct Script;  // gsv/model/script.h

// The data of one model. A placed model is a PlacedModel (gsv/model/world_description.h).
struct Model {
  std::string name;    // the model's name in the file
  std::string source;  // the file of the model, for messages
  // True if neither forces nor a drive move the model.
  bool is_static = false;
  // The pose in the file, used in a world if no other pose is given.
  geometry::Pose default_pose;
  // Whether the file places the model by one of its frames (//model/@placement_frame).
  bool has_placement_frame = false;
  std::vector<Link> links;    // links[0] is the canonical link; never empty
  std::vector<Joint> joints;  // a forest: each link is the child of at most one joint
  // Joints that close loops of links: each connects two links of the forest. They apply only with
  // rigid-body dynamics. Such a joint takes no commands. Its position is not in the world's state,
  // and its limits, damping and friction are ignored. Its kind is fixed, revolute, continuous,
  // prismatic or ball.
  std::vector<Joint> loop_joints;
  std::vector<JointTarget> joint_targets;  // at most one per joint
  std::vector<double> start_positions;     // initial positions of the joints; empty: all zero
  std::vector<SensorDescription> sensors;
  std::vector<ControlSystem> control_systems;
  std::optional<Drive> drive;             // set if the model is a robot, which can have a behaviour
  Movement movement = Movement::kPlanar;  // only for a model with a drive
  std::shared_ptr<const Script> script;   // the motion of an actor; null for other models
};

// Returns the radius of a circle about the model's origin in its xy plane. The circle contains the
// bounding boxes of all collisions except planes.
double FootprintRadius(const Model& model);

// Returns the lowest z, in the model's frame, of the bounding boxes of all collisions except
// planes; 0 without collisions. Exact for boxes; a lower bound for tilted round shapes.
double LowestPoint(const Model& model);
// Returns the lowest z of a rotated model, relative to its origin.
double LowestPoint(const Model& model, const geometry::Quaternion& world_from_model);

}  // namespace gsv::model
