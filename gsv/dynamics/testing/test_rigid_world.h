// Small worlds of rigid bodies for tests.
#pragma once

#include "gsv/dynamics/testing/test_world.h"
#include "gsv/dynamics/world_engine.h"

namespace gsv::dynamics::testing {

inline constexpr double kG = 9.8;  // m/s²

// Upright.
inline geometry::Pose At(double x, double y, double z) { return {{x, y, z}, {}}; }

// A solid of one shape, with its inertia from textbook formulas.
inline std::shared_ptr<model::Model> SolidOf(const geometry::Shape& shape, double mass,
                                             const model::Surface& surface = {}) {
  auto model = ModelOf(shape);
  model->links[0].collisions[0].surface = surface;
  model::Inertial& inertial = model->links[0].inertial;
  inertial.mass = mass;
  if (const auto* box = std::get_if<geometry::Box>(&shape)) {
    const auto& s = box->size;
    inertial.ixx = mass * (s.y * s.y + s.z * s.z) / 12;
    inertial.iyy = mass * (s.x * s.x + s.z * s.z) / 12;
    inertial.izz = mass * (s.x * s.x + s.y * s.y) / 12;
  } else if (const auto* sphere = std::get_if<geometry::Sphere>(&shape)) {
    inertial.ixx = inertial.iyy = inertial.izz = 0.4 * mass * sphere->radius * sphere->radius;
  } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape)) {
    const double r2 = cylinder->radius * cylinder->radius, l2 = cylinder->length * cylinder->length;
    inertial.ixx = inertial.iyy = mass * (3 * r2 + l2) / 12;
    inertial.izz = mass * r2 / 2;
  }
  return model;
}

// A horizontal plane with this surface, as a model.
inline std::shared_ptr<model::Model> GroundOf(const model::Surface& surface = {}) {
  auto model = ModelOf(geometry::Plane{});
  model->links[0].collisions[0].surface = surface;
  return model;
}

inline TestWorld WorldOnGround(const model::Surface& surface = {}) {
  TestWorld world(MakeWorldEngine());
  world.AddStatic("ground", GroundOf(surface), {});
  return world;
}

// Returns kinetic energy plus potential energy above z = 0 of all bodies, each of one link.
inline double EnergyOf(const TestWorld& world) {
  double energy = 0;
  for (std::size_t i = 0; i < world.layout().bodies.size(); ++i) {
    const world::Body& body = world.layout().bodies[i];
    if (!body.is_rigid()) continue;
    const world::BodyState& state = world.state().bodies[i];
    const model::Inertial& inertial = body.model->links[0].inertial;
    const auto w = Inverse(state.world_from_model.orientation) * state.angular_velocity;
    energy += inertial.mass * (Dot(state.linear_velocity, state.linear_velocity) / 2 +
                               9.8 * state.world_from_model.position.z) +
              (inertial.ixx * w.x * w.x + inertial.iyy * w.y * w.y + inertial.izz * w.z * w.z) / 2;
  }
  return energy;
}

}  // namespace gsv::dynamics::testing
