// The state on which the next step depends: simple values, and immutable states of devices.
//
// Frames  poses are world_from_model; velocities are of the model's origin, in world axes.
// Units   metres, radians, seconds.
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/hash.h"
#include "gsv/base/sim_time.h"
#include "gsv/geometry/planar_motion.h"
#include "gsv/geometry/pose.h"
#include "gsv/world/device_state.h"
#include "gsv/world/layout.h"

namespace gsv::world {

// A command to a base, in the base's frame. It is applied from the step at which it is given until
// the next command, but at most for Drive::command_timeout.
struct DriveCommand {
  double linear = 0;   // m/s, forward
  double lateral = 0;  // velocity to the left, m/s; ignored by drives that cannot move sideways
  double angular = 0;  // rad/s, counter-clockwise
  friend bool operator==(const DriveCommand&, const DriveCommand&) = default;
};

inline bool IsFinite(const DriveCommand& command) {
  return geometry::IsFinite(geometry::Vector3{command.linear, command.lateral, command.angular});
}

// The command of a drive, and its current velocity.
struct DriveState {
  DriveCommand command;
  base::SimTime command_time{0};  // time at which the command was given
  DriveCommand actual;            // the current velocity, within acceleration limits
};

// The pose of a base relative to its initial pose, computed from the rotation of its wheels (dead
// reckoning); see wheel_odometry.h.
struct Odometry {
  // position of the reference point, in the frame of the initial pose
  geometry::PlanarPosition place;
  double linear = 0, angular = 0;  // linear and angular velocity over the last step, m/s, rad/s
};

// The pose and the motion of one body.
struct BodyState {
  geometry::Pose world_from_model;
  geometry::Vector3 linear_velocity;
  geometry::Vector3 angular_velocity;
  DriveState drive;
  Odometry odometry;
  double distance = 0;     // distance that the model's origin has travelled, m
  base::SimTime since{0};  // time at which the body was added
  // number of contacts that began (a contact counts once, even if it lasts many steps)
  std::uint64_t collisions = 0;
  // Whether the robot touched a body other than the ground in the last step.
  bool in_contact = false;
};

// A command to a joint of a rigid body or of a robot. It applies until the next command.
struct JointCommand {
  enum class Kind : std::uint8_t {
    kNone,      // no command; only damping and friction of the joint act
    kPosition,  // rad or m; velocity and effort limits apply
    kVelocity,  // rad/s or m/s; the effort limit applies
    kEffort,    // N m or N; the effort limit applies
  };
  Kind kind = Kind::kNone;
  double value = 0;  // in the unit that the kind states
  friend bool operator==(const JointCommand&, const JointCommand&) = default;
};

// Data that an engine of rigid-body dynamics needs from the last step. For example, its solver
// starts with the impulses of the last step. Immutable, so that states can share the data.
class EngineState {
 public:
  virtual ~EngineState() = default;
  virtual void AddToHash(base::Hash& hash) const = 0;
};

// The state of all bodies, joints and devices at one instant.
struct State {
  std::int64_t step = 0;
  base::SimTime time{0};
  std::vector<BodyState> bodies;  // in the order of Layout::bodies
  // The joints of body b start at Layout::bodies[b].first_joint.
  std::vector<double> joint_positions;
  // A ball joint consists of three joints (JointKind::kBall). Their values are the components of
  // the ball joint's angular velocity about the three axes of the child.
  std::vector<double> joint_velocities;
  // The command of each joint, in the order of joint_positions; empty before the first command.
  std::vector<JointCommand> joint_commands;
  // N m or N: the integral terms of the joints' controllers (model::JointGains), in the order of
  // joint_positions; empty if no joint has an integral term
  std::vector<double> joint_integrals;
  // Number of goals that each pedestrian has reached, in the order of `bodies`; may be empty.
  std::vector<std::uint32_t> goals;
  std::shared_ptr<const DeviceStates> devices;  // null while no device has a state
  std::shared_ptr<const EngineState> engine;    // null if the engine needs no data of the last step
};

// Returns the state at the start: initial poses, at rest, with the joint targets of the models.
State InitialState(const Layout& layout);

// Whether the joint belongs to a drive: a wheel or a steering joint.
bool IsOfDrive(const model::Model& model, int joint);

// Fails for commands that are not finite, and if the joint does not exist or accepts no commands.
// For a body without rigid-body dynamics, also fails for efforts, for joints of the drive, and if
// the body is not a robot.
base::Status CheckJointCommand(const Body& body, int joint, const JointCommand& command);

// Sets the command of a joint.
void CommandJoint(const Layout& layout, int body, int joint, const JointCommand& command,
                  State& state);

// Adds every field of `state`, and the bodies' names, to the hash, in canonical order.
void AddToHash(const Layout& layout, const State& state, base::Hash& hash);

}  // namespace gsv::world
