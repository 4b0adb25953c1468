// The equations of motion of a rigid body, or of parts that joints connect, in joint coordinates.
// So joints cannot drift apart.
//
// Velocities  one number for each degree of freedom. The base's velocities come first, unless the
//             base is fixed: its angular velocity, then the velocity of its centre of mass, in the
//             world. The joints' velocities follow, part by part. A ball joint has three: its
//             angular velocity in the child's frame.
// Frames      the origin of a part's frame is its centre of mass (Articulation).
// Method      mass matrix by composite bodies, and a factorisation that keeps its zeros
//             (Featherstone, Rigid Body Dynamics Algorithms, 2008, sections 6.2 and 6.5). A body
//             without joints has gyroscopic torques by one implicit Newton step (Catto, Numerical
//             Methods, GDC 2015).
#pragma once

#include <span>
#include <vector>

#include "gsv/dynamics/motion/ball_angles.h"
#include "gsv/dynamics/rigid/matrix3.h"
#include "gsv/dynamics/rigid/rigid_body.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

// The state and the equations of motion of a tree of links that joints connect.
class LinkTree {
 public:
  explicit LinkTree(const RigidBody& plan);

  // Reads pose and velocities from the state.
  void Load(const world::State& state);
  // Computes the poses of the parts, from the pose of the base and the joints' positions.
  void Place();
  // Computes the mass matrix and factorises it. Call it after Place().
  void WriteMass();

  // Removes all forces and efforts that were added.
  void ClearForces();
  // Adds a force (N) and a torque (N m) at a part's centre of mass, in the world.
  void AddForce(int part, const geometry::Vector3& force, const geometry::Vector3& torque);
  // Adds an effort (N or N m) to one velocity of a joint.
  void AddEffort(int velocity, double effort) { efforts_[Index(velocity)] += effort; }
  // Computes free(): the velocities after `seconds` under the added forces and efforts, and under
  // centrifugal, Coriolis and gyroscopic effects, but without impulses of constraints. Also
  // computes free_momenta(), the mass matrix times these velocities. Call it after WriteMass().
  void Accelerate(double seconds);

  // Moves the tree by `velocities` for `seconds`.
  void Move(std::span<const double> velocities, double seconds);
  // Translates and rotates the base.
  void Shift(const geometry::Vector3& shift, const geometry::Vector3& turn);

  // The number of velocities.
  int size() const { return size_; }
  // Returns the index of a part's first velocity; 0 for the base.
  int first_velocity(int part) const { return links_[Index(part)].first; }
  // Whether the base can move.
  bool is_moved_base() const { return base_size_ > 0; }
  // Whether the tree is a single part without joints.
  bool is_single() const { return links_.size() == 1; }
  std::span<double> velocities() { return velocities_; }
  std::span<const double> velocities() const { return velocities_; }
  // The velocities that Accelerate() has computed.
  std::span<const double> free() const { return free_; }
  // The mass matrix times free().
  std::span<const double> free_momenta() const { return free_momenta_; }
  // Returns a value of the mass matrix. `column` must not exceed `row`, because only the lower
  // triangle is valid.
  double mass(int row, int column) const { return masses_[Index(row * size_ + column)]; }

  double part_mass(int part) const { return links_[Index(part)].mass; }
  // Returns the inverse inertia, in the world, of a body without joints. Valid after WriteMass().
  const Matrix3& inverse_inertia() const { return inverse_inertia_; }

  // The position of a part's centre of mass, in the world.
  const geometry::Vector3& position(int part) const { return positions_[Index(part)]; }
  // The axes of a part's frame, in the world.
  const Matrix3& rotation(int part) const { return rotations_[Index(part)]; }
  // Returns the pose of a part's frame in the world.
  geometry::Pose pose(int part) const;
  // Returns the angular velocity of a part, in the world.
  geometry::Vector3 angular_velocity(int part) const;
  // Returns the velocity of a point that is fixed to a part. Both are in the world.
  geometry::Vector3 VelocityOf(int part, const geometry::Vector3& point) const;
  // Returns the velocity of the base's centre of mass, in the world.
  geometry::Vector3 base_velocity() const;
  // Returns the angular velocity of the base, in the world.
  geometry::Vector3 base_angular_velocity() const;
  // Sets the velocity and the angular velocity of the base, in the world.
  void SetBaseVelocity(const geometry::Vector3& velocity,
                       const geometry::Vector3& angular_velocity);

  double joint_position(int part) const { return joint_positions_[Index(part)]; }
  double joint_velocity(int part) const { return velocities_[Index(first_velocity(part))]; }
  // Returns the rotation of a ball joint from its zero position.
  const geometry::Quaternion& turn(int part) const { return turns_[Index(part)]; }

  // Returns the indices of the velocities that move a part: first the velocities of its own joint,
  // and last the velocities of the base.
  std::span<const int> Chain(int part) const { return links_[Index(part)].chain; }
  // How a part moves if one velocity of the tree is 1 and all others are 0: the angular velocity of
  // the part, and the velocity of a point of the part.
  struct Motion {
    geometry::Vector3 turning, moving;  // angular velocity and velocity, in the world
  };
  // For each velocity in the part's chain, computes the velocity of a point of the part if that
  // velocity is 1 and all others are 0.
  void PointMotions(int part, const geometry::Vector3& point,
                    std::vector<geometry::Vector3>& motions) const;
  // The angular velocity (in the world) of the moved parts if `velocity` is 1 and all others are 0.
  const geometry::Vector3& turning(int velocity) const { return motions_[Index(velocity)].turning; }

  // Returns J M⁻¹ Jᵀ of a row with values for the velocities of a part's chain.
  double Response(int part, std::span<const double> row) const;
  // Computes M⁻¹ Jᵀ of a row with values for all velocities, in place.
  void Respond(std::span<double> row) const;

 private:
  // A part, with the joint between it and its parent.
  struct Link {
    int parent = -1, joint = -1;  // parent part, and joint of the model; -1 for the base
    int first = 0, count = 0;     // range of the velocities of its joint
    model::JointKind kind = model::JointKind::kFixed;
    // orientation in the parent's frame with the joint at zero
    geometry::Quaternion parent_from_part;
    // The axis of the joint, in the part's frame. The pivot (the joint's origin), in the parent's
    // frame. The vector from the pivot to the part's centre of mass, in the part's frame.
    geometry::Vector3 axis, pivot_in_parent, arm;
    double pitch = 0, mass = 0, heaviness = 1;  // pitch of a screw joint, m/rad, else 0; see Part
    geometry::Vector3 inertia;  // principal moments, about the axes of the part's frame, kg m²
    std::vector<int> chain;     // see Chain()
  };
  // The inertia of a part with all parts below it in the tree.
  struct Inertia {
    double mass;               // kg
    geometry::Vector3 moment;  // mass times the vector from the base's centre of mass, world, kg m
    Matrix3 turning;           // inertia about the base's centre of mass, world, kg m²
  };
  static std::size_t Index(int i) { return static_cast<std::size_t>(i); }
  Link LinkOf(int part) const;
  // Computes the pose of a part from the pose of its parent.
  void PlaceLink(int part);
  // Writes the mass matrix of a body without joints.
  void WriteSingle();
  // Writes the row of the mass matrix for `velocity`.
  void WriteMassesOf(int part, int velocity);
  // Factorises the mass matrix.
  void Factorise();
  // Accelerates a body without joints.
  void AccelerateSingle(double seconds);
  // Adds the forces on the parts, and subtracts the efforts of centrifugal, Coriolis and gyroscopic
  // effects.
  void AddBias();
  double& MassAt(int row, int column) { return masses_[Index(row * size_ + column)]; }

  const RigidBody& plan_;  // the body whose links form the tree
  std::vector<Link> links_;
  std::vector<BallAngles> balls_;  // one for each ball joint
  std::vector<int> ball_of_;       // index in balls_ for each part; -1: none
  int size_ = 0, base_size_ = 6;   // numbers of velocities: of the tree, and of its base (6 or 0)
  // for each velocity, the index of the next velocity on the chain to the base; -1: none
  std::vector<int> parents_;

  geometry::Quaternion base_;                // orientation of the base
  std::vector<geometry::Quaternion> turns_;  // rotation of the ball joint of each part
  std::vector<double> joint_positions_;      // one for each part
  // The poses of the parts in the world.
  std::vector<geometry::Quaternion> orientations_;
  std::vector<Matrix3> rotations_;
  std::vector<geometry::Vector3> positions_;
  std::vector<double> velocities_, free_, free_momenta_, efforts_;  // one for each velocity
  std::vector<geometry::Vector3> forces_, torques_;  // added forces and torques, one for each part
  // One for each velocity. `moving` is the velocity of the point that is fixed to the moved part
  // and coincides with the base's centre of mass.
  std::vector<Motion> motions_;
  std::vector<Inertia> inertias_;         // one for each part
  std::vector<Matrix3> own_inertias_;     // inertia of each part about its centre of mass
  std::vector<double> masses_, factors_;  // the mass matrix, and its factorisation
  Matrix3 inverse_inertia_;               // inverse inertia of a single body
  mutable std::vector<double> scratch_;   // memory that is used again in each call
  // Memory for AddBias(), one for each part: accelerations that the motion itself requires, and
  // velocities. Both are angular and linear.
  std::vector<geometry::Vector3> bias_turning_, bias_moving_, spins_, speeds_;
};

}  // namespace gsv::dynamics
