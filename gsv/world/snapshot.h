// The world at one instant. It is immutable and shared; any number of threads may read it.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "gsv/world/radio.h"
#include "gsv/world/state.h"

namespace gsv::world {

// One of the points at which two bodies touch.
struct ContactPoint {
  geometry::Vector3 point;   // world
  geometry::Vector3 normal;  // normal in the world, unit length, from the first body to the second
  double depth = 0;          // m
  // Impulse on the second body over the step, in the world, N s: friction and normal force; zero if
  // the engine does not compute it.
  geometry::Vector3 impulse;
};

// A contact of two bodies. The normal points from the first body to the second. If a robot touches
// a static body or the ground, the robot is the first body. Point, normal and depth are the values
// of the deepest point.
struct Contact {
  int first = 0;             // index of the first body in the layout
  int second = 0;            // index of the second body
  geometry::Vector3 point;   // world
  geometry::Vector3 normal;  // normal in the world, unit length
  double depth = 0;          // m
  bool began = false;        // true if the bodies did not touch one step earlier
  double closing_speed = 0;  // m/s along the normal at the start of the contact; 0 unless `began`
  // Impulse along the normal over the step, N s, summed over all contact points; NaN if the engine
  // does not compute it. Planar kinematics computes the impulse only when a robot pushes a body.
  double impulse = std::numeric_limits<double>::quiet_NaN();
  // Whether the second body (static, planar or an actor) supports the first body from below, like
  // the ground. Such a contact is not a collision: only contact sensors report it.
  bool supports = false;
  // All contact points of two rigid bodies, the deepest first, at the end of the last substep in
  // which the bodies touched. The impulses of the points add up to the impulse of the whole step.
  // Empty if the engine computes only the deepest point.
  std::vector<ContactPoint> points;
};

// Returns the contact's points, at least one. If `points` is empty, this is the deepest point, with
// an impulse along the normal.
std::vector<ContactPoint> PointsOf(const Contact& contact);

// The acceleration of a model's origin, in world axes: the mean over the last step.
struct Acceleration {
  geometry::Vector3 linear;   // m/s²
  geometry::Vector3 angular;  // rad/s²
};

// The bodies of a world and their state at one instant, with the contacts of the last step.
struct Snapshot {
  std::shared_ptr<const Layout> layout;  // never null
  State state;
  std::vector<Contact> contacts;  // contacts of the last step, ordered by (first, second, supports)
  base::SimTime step_length{0};   // length of the last step; 0 before the first step
  // In the order of Layout::bodies; empty before the first step.
  std::vector<Acceleration> accelerations;
  // Mean accelerations of the joints over the last step, rad/s² or m/s², in the order of
  // State::joint_velocities; empty before the first step.
  std::vector<double> joint_accelerations;
  // Messages that were sent in the last step, ordered by sender.
  std::vector<Transmission> transmissions;
};

// Returns the mean force over the last step that corresponds to an impulse (N s); zero before the
// first step.
geometry::Vector3 MeanForce(const Snapshot& snapshot, const geometry::Vector3& impulse);

// Call KeepVelocities() before a step, and the other functions after the step, in this order.
// KeepVelocities() stores the velocities in `accelerations` and `joint_accelerations`.
// FinishContacts() computes closing speeds from these velocities (`kept`). FinishAccelerations()
// replaces the velocities by the mean accelerations.
void KeepVelocities(const State& state, std::vector<Acceleration>& accelerations,
                    std::vector<double>& joint_accelerations);
void FinishContacts(const State& state, const std::vector<Acceleration>& kept,
                    std::vector<Contact>& contacts);
void FinishAccelerations(const State& state, double step_seconds,
                         std::vector<Acceleration>& accelerations,
                         std::vector<double>& joint_accelerations);

// Returns model_from_link of a model's links at the given joint positions (one for each joint). A
// revolute joint rotates its child about the joint's axis, a prismatic joint moves the child along
// the axis, and a screw joint does both.
std::vector<geometry::Pose> LinkPoses(const model::Model& model,
                                      std::span<const double> joint_positions);

// Returns world_from_link for every link of one body.
std::vector<geometry::Pose> LinkPoses(const Snapshot& snapshot, int body);

// Returns world_from_link for one link of one body.
geometry::Pose LinkPose(const Snapshot& snapshot, int body, int link);

// Returns model_from_link for one link of one body, like LinkPoses().
geometry::Pose ModelFromLink(const Snapshot& snapshot, int body, int link);

// Returns the indices of the links that move relative to the model's frame. These are the links
// below a joint that is not fixed.
std::vector<int> MovingLinks(const model::Model& model);

}  // namespace gsv::world
