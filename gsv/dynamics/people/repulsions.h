// The forces of the social force model (social_force.h) for many pairs at once.
//
// The values are bit-identical to the results of Apart(), RepulsionByOther() and AsSeen(): the
// operations and their order are the same, but each instruction processes several pairs.
//
// Units    metres, seconds. Vectors in the plane of the world.
// Threads  each thread has its own object.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "gsv/geometry/vector3.h"

namespace gsv::dynamics {

// Computes the social forces between many pairs of bodies at once.
class Repulsions {
 public:
  // Adds the force of another body on the pedestrian `walker` to forces[walker], in this call or
  // later, at the latest in Finish(). The forces of one pedestrian are added in the order of the
  // calls. `between` is the vector from the other body's centre to the pedestrian's centre. `radii`
  // is the sum of both radii. `wanted` is the desired direction, as for AsSeen().
  void Add(std::uint32_t walker, geometry::Vector2 between, double radii,
           geometry::Vector2 other_velocity, geometry::Vector2 wanted,
           std::span<geometry::Vector2> forces) {
    if (count_ == kPairs) Finish(forces);
    walker_[count_] = walker;
    x_[count_] = between.x;
    y_[count_] = between.y;
    radii_[count_] = radii;
    velocity_x_[count_] = other_velocity.x;
    velocity_y_[count_] = other_velocity.y;
    wanted_x_[count_] = wanted.x;
    wanted_y_[count_] = wanted.y;
    ++count_;
  }

  // Adds the forces of all pairs that Add() has only stored.
  void Finish(std::span<geometry::Vector2> forces);

 private:
  static constexpr std::size_t kPairs = 256;  // maximum number of stored pairs
  using Column = std::array<double, kPairs>;

  std::size_t count_ = 0;  // number of stored pairs
  // The arguments of Add(), one entry per pair.
  std::array<std::uint32_t, kPairs> walker_;
  alignas(64) Column x_, y_, radii_, velocity_x_, velocity_y_, wanted_x_, wanted_y_;
  // Values that Finish() computes for each pair.
  alignas(64) Column exponent_, direction_x_, direction_y_, sum_, b_;
};

}  // namespace gsv::dynamics
