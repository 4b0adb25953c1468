// All that the next step depends on: plain data, and the states of devices, which are immutable.
//
// Frames  poses are world_from_model; velocities are those of the model's origin, in world axes.
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

// What a base is told to do, in its own frame. It acts from the step it is given at until the next
// one is given (or Drive::command_timeout passes).
struct DriveCommand {
  double linear = 0;   // m/s, forward
  double lateral = 0;  // m/s, to the left; only some drives can
  double angular = 0;  // rad/s, counter-clockwise
  friend bool operator==(const DriveCommand&, const DriveCommand&) = default;
};

inline bool IsFinite(const DriveCommand& command) {
  return geometry::IsFinite(geometry::Vector3{command.linear, command.lateral, command.angular});
}

struct DriveState {
  DriveCommand command;
  base::SimTime command_time{0};  // when the command was given
  DriveCommand actual;            // what the base does now, within its acceleration limits
};

// Where a base believes to be by its wheels' turning, from where it started; see wheel_odometry.h.
struct Odometry {
  geometry::PlanarPosition place;  // of its reference point, in the frame of its start
  double linear = 0, angular = 0;  // m/s, rad/s: over the last step
};

struct BodyState {
  geometry::Pose world_from_model;
  geometry::Vector3 linear_velocity;
  geometry::Vector3 angular_velocity;
  DriveState drive;
  Odometry odometry;
  double distance = 0;           // m that the model's origin has travelled
  std::uint64_t collisions = 0;  // contacts that began (not: steps in contact)
  bool in_contact = false;       // touched something, other than the ground, in the last step
};

// What a joint that forces move is told to do, until it is told something else.
struct JointCommand {
  enum class Kind : std::uint8_t {
    kNone,      // its own damping and friction only
    kPosition,  // rad or m: to be there, at its velocity and effort limits at most
    kVelocity,  // rad/s or m/s, at its effort limit at most
    kEffort,    // N m or N, within its effort limit
  };
  Kind kind = Kind::kNone;
  double value = 0;
  friend bool operator==(const JointCommand&, const JointCommand&) = default;
};

// What an engine of rigid-body dynamics keeps from one step to the next because the outcome depends
// on it, such as the impulses from which its solver starts. Immutable, so that states can share it.
class EngineState {
 public:
  virtual ~EngineState() = default;
  virtual void AddToHash(base::Hash& hash) const = 0;
};

struct State {
  std::int64_t step = 0;
  base::SimTime time{0};
  std::vector<BodyState> bodies;        // as Layout::bodies
  std::vector<double> joint_positions;  // body b's start at Layout::bodies[b].first_joint
  // Those of a ball joint are its angular velocity about its three axes, as the child carries them.
  std::vector<double> joint_velocities;
  std::vector<JointCommand> joint_commands;  // as joint_positions; empty: none was ever given
  // How many goals each pedestrian has reached, as `bodies`; empty: there are no pedestrians.
  std::vector<std::uint32_t> goals;
  std::shared_ptr<const DeviceStates> devices;  // null: none has ever had a state
  std::shared_ptr<const EngineState> engine;    // null: the engine keeps nothing
};

// Everything where it starts and at rest; joints have their models' targets.
State InitialState(const Layout& layout);

// Whether a drive turns that joint: a wheel, or one that steers.
bool IsOfDrive(const model::Model& model, int joint);

// Refuses commands that are not finite, that the body cannot follow (effort, where no forces move
// it), or that are for a joint which is not there, takes none, or is the drive's.
base::Status CheckJointCommand(const Body& body, int joint, const JointCommand& command);

// Tells a joint of a body what to do.
void CommandJoint(const Layout& layout, int body, int joint, const JointCommand& command,
                  State& state);

// Adds every field of `state`, and the bodies' names, in canonical order.
void AddToHash(const Layout& layout, const State& state, base::Hash& hash);

}  // namespace gsv::world
