// Wind and fluids, which push the bodies of a world.
//
// Units  SI; heights are z in the world.
#pragma once

#include <string>
#include <vector>

#include "gsv/geometry/vector3.h"

namespace gsv::model {

// Wind as in Gazebo's WindEffects. If wind is enabled for a link, the force on its centre of mass
// is `drag` times its mass times the velocity of the wind relative to the link.
struct Wind {
  geometry::Vector3 velocity;  // m/s
  double drag = 1;             // <force_approximation_scaling_factor>, 1/s
};

// A fluid as in Gazebo's Buoyancy. The fluid pushes a body up with a force that equals the weight
// of the displaced fluid. This force acts at the centre of the displaced volume.
struct Fluid {
  struct Layer {
    double above = 0;    // the height at which the layer begins, m
    double density = 0;  // kg/m³
  };
  double density = 1000;      // density below all layers, kg/m³
  std::vector<Layer> layers;  // by ascending height; each layer ends where the next one begins
  // The models ("boat") and links ("boat::hull") that float; empty for all.
  std::vector<std::string> lifted;
};

}  // namespace gsv::model
