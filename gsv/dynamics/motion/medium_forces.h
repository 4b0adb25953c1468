// Forces of the surrounding medium on a rigid body: wind, fluids, and the decay of its velocity.
//
// Frames  wrenches, velocities: world axes; torques about the part's centre of mass.
// Units   N, N m, m/s, rad/s.
// Source  Gazebo's systems WindEffects and Buoyancy; for <velocity_decay>: Gazebo with ODE, where a
//         body loses a fraction of its velocity in each step of the world.
#pragma once

#include <vector>

#include "gsv/dynamics/motion/articulation.h"
#include "gsv/world/layout.h"

namespace gsv::dynamics {

// A collision shape that displaces fluid, in its part's frame.
struct Displacer {
  double volume = 0;         // m³
  geometry::Vector3 centre;  // centre of the volume
  double radius = 0;         // radius of a sphere in a fluid with layers; else 0
  // closed surface of any other shape; empty if the fluid has no layers
  geometry::TriangleMesh surface{};
  double reach = 0;              // distance of the farthest point from `centre`, m
  double volume_of_surface = 0;  // volume inside `surface`, m³
};

// The properties of one part of a body that these forces depend on.
struct PartMedium {
  // The fraction of the velocity that is lost in a step of the world.
  double linear_decay = 0, angular_decay = 0;
  double mass_in_wind = 0;  // kg
  std::vector<Displacer> displacers;
};

// Returns an entry for each part of the body. The vector is empty if the medium exerts no force on
// the body.
std::vector<PartMedium> MakeMedium(const world::Layout& layout, const world::Body& body,
                                   const Articulation& articulation);

// A force (N) on a part, and a torque (N m) about the part's centre of mass, in world axes.
struct Wrench {
  geometry::Vector3 force, torque;
};

// The pose of a part, the velocity of its centre of mass (m/s), and its angular velocity (rad/s).
// Both velocities are in world axes.
struct PartMotion {
  geometry::Pose world_from_part;
  geometry::Vector3 velocity, angular_velocity;
};

// Returns the mean wrench over the next `seconds`, which must be at most one step of the world.
Wrench WrenchOf(const PartMedium& medium, const Part& part, const PartMotion& motion,
                const model::WorldDescription& world, double seconds);

}  // namespace gsv::dynamics
