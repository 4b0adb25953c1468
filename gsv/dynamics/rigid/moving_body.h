// One body that rigid-body dynamics moves: its equations of motion, the forces on it, and the
// commands that it follows. It lives as long as the layout.
#pragma once

#include <optional>
#include <vector>

#include "gsv/dynamics/motion/drive_servo.h"
#include "gsv/dynamics/rigid/loop_rows.h"

namespace gsv::dynamics {

// A rigid body during a step: its equations of motion, forces and commands.
class MovingBody {
 public:
  // `world` is the body's world. `plan` and `world` must outlive this object.
  MovingBody(const RigidBody& plan, const model::WorldDescription& world);

  // Begins a step from this state.
  void Load(const world::State& state);
  // Computes the poses of the parts.
  void Place();
  // Prepares a substep: applies commands, sets the forces and the rows of the joints (rows()), and
  // computes the velocities that the body would have without impulses.
  void BeforeSubstep(double seconds);
  // Sets the velocities at the end of the substep, and moves the body. A body with one part and
  // without contacts follows a parabola.
  void AfterSubstep(std::span<const double> velocities, bool is_touched, double seconds);
  // Moves by this velocity in this substep only. Call it after AfterSubstep().
  void Separate(const geometry::Vector3& velocity, double seconds);

  // An upper bound of the speed of all points, in m/s.
  double Speed() const;
  // Half of the smallest thickness of any part, m.
  double thickness() const { return thickness_; }

  // Writes the body's pose, velocities and joints to `state`. Returns true if the body was at rest
  // and still is. Then its pose and joint positions stay as they are, and its velocities are 0.
  bool Store(double seconds, world::State& state) const;

  const RigidBody& plan() const { return plan_; }
  LinkTree& tree() { return tree_; }
  const LinkTree& tree() const { return tree_; }
  const JointRows& rows() const { return rows_; }
  // Whether the body moves at its own velocity, and contacts have no effect on it.
  bool is_kinematic() const { return is_kinematic_; }
  // Whether the body's drive sets the velocity of the base directly, without forces of the wheels.
  bool is_held() const { return servo_.has_value() && !rolls_; }
  // Returns the velocity of a point of a part, in the world.
  geometry::Vector3 VelocityOf(int part, const geometry::Vector3& point) const;
  // Returns the absolute rate of a wheel about its axle, in rad/s; 0 for a part on a ball joint,
  // which has no axle.
  double WheelRate(int part) const;

 private:
  struct Motor {
    // Index of the part in the articulation, of the joint in the model, of the velocity in the
    // tree.
    int part, joint, velocity;
  };

  const Part& part(int index) const {
    return plan_.articulation.parts[static_cast<std::size_t>(index)];
  }
  const model::Joint& JointOf(const Motor& motor) const {
    return plan_.model->joints[static_cast<std::size_t>(motor.joint)];
  }
  // Adds gravity, wind, fluids and the decay of velocities for each part.
  void AddForces(double seconds);
  // Advances the drive, and computes the rates of its joints.
  void Drive(double seconds);
  // Returns the command of a joint, which comes from the drive or from outside.
  world::JointCommand CommandOf(int joint) const;
  // Adds the rows of all joints.
  void AddJointRows(double seconds);
  // Adds the rows and efforts by which a joint follows its command.
  void AddMotor(const Motor& motor, double seconds);
  // Adds an effort of the joint, and its friction.
  void AddPush(const Motor& motor, double force, double seconds);
  // Adds the row of a joint's controller. Returns a number with the sign of its effort.
  double AddControl(const Motor& motor, const world::JointCommand& command, double seconds);
  // Adds a row that keeps a joint within its velocity limit.
  void AddVelocityLimit(const Motor& motor, double force, double seconds);
  // Adds rows that keep a joint within its position limits.
  void AddPositionLimits(const Motor& motor, double seconds);
  // Adds a row that moves the joint at `rate`, with at most this impulse.
  void AddRow(const Motor& motor, double rate, double impulse);
  // Adds the row of a joint that follows another joint, as gears do.
  void Follow(const Motor& motor, const model::Mimic& mimic, double seconds);
  // Writes the positions and velocities of all joints to `state`.
  void StoreJoints(bool rests, world::State& state) const;
  // Writes the angles and rates of a ball joint to `state`.
  void StoreBall(int part, bool rests, world::State& state) const;
  // Returns the speed of a part's joint, rad/s or m/s.
  double Rate(int part) const;
  // Returns the pose of the model's frame in the world.
  geometry::Pose WorldFromModel() const;
  // Returns the speed that is compared with kResting: the maximum of all linear and angular speeds.
  double RestingSpeed() const;

  const RigidBody& plan_;
  const model::WorldDescription& world_;
  LinkTree tree_;
  JointRows rows_;
  std::vector<LoopJoint> loops_;  // joints that close loops of links
  std::vector<Motor> motors_;
  std::optional<DriveServo> servo_;            // nullopt if the body has no drive
  std::vector<world::JointCommand> commands_;  // commands of the model's joints; may be empty
  std::vector<double> integrals_;              // integral terms of the model's joints; may be empty
  // positions and rates that the drive commands to its joints
  std::vector<double> wanted_positions_, wanted_rates_;
  bool is_kinematic_, rolls_;  // see is_kinematic(); whether the drive's wheels propel the base
  double thickness_;           // see thickness()
  geometry::Vector3 velocity_, angular_velocity_;  // velocities of a kinematic body
  geometry::Vector3 outer_acceleration_;  // m/s²: acceleration of a single body due to outer forces
  double resting_speed_before_ = 0;       // RestingSpeed() at the start of the step
  double separating_speed_ = 0;  // m/s: the greatest speed given to Separate() in this step
  // whether something can keep the body at rest in this step (kResting); unrelated to is_held()
  bool is_held_ = false;
};

// A body counts as resting if its speed is below kResting (m/s², rad/s²) times the step, before and
// after the step. A resting body keeps its pose bit-identical. The effect equals a rolling
// resistance of one per cent: a body on a slope of half a degree does not start to roll. Only a
// body that something can hold may rest: a contact, a medium, or a joint with a motor, friction or
// a reached limit.
inline constexpr double kResting = 0.1;

}  // namespace gsv::dynamics
