// The surroundings of a world's bodies that push them: wind, and fluids that they float in.
//
// Units  SI; heights are z in the world.
#pragma once

#include <string>
#include <vector>

#include "gsv/geometry/vector3.h"

namespace gsv::model {

// Wind as in Gazebo's WindEffects. It pushes each link that has wind at its centre of mass, with
// `drag` times its mass times the relative velocity of the wind.
struct Wind {
  geometry::Vector3 velocity;  // m/s
  double drag = 1;             // in 1/s: <force_approximation_scaling_factor>
};

// A fluid as in Gazebo's Buoyancy. It lifts bodies by the weight of the displaced fluid, at the
// centre of the displaced volume.
struct Fluid {
  struct Layer {
    double above = 0;    // the height at which the layer begins, m
    double density = 0;  // kg/m³
  };
  double density = 1000;      // density below all layers, kg/m³
  std::vector<Layer> layers;  // by ascending height; each layer ends where the next one begins
  // The models ("boat") and links ("boat::hull") that the fluid lifts; empty for all.
  std::vector<std::string> lifted;
};

}  // namespace gsv::model
