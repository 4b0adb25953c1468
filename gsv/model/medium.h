// The surroundings of a world's bodies that push them: wind, and fluids that they float in.
//
// Units  SI; heights are z in the world.
#pragma once

#include <string>
#include <vector>

#include "gsv/geometry/vector3.h"

namespace gsv::model {

// Pushes each link that has wind with `drag` times its mass times the velocity of the wind against
// it, at its centre of mass: Gazebo's WindEffects.
struct Wind {
  geometry::Vector3 velocity;  // m/s
  double drag = 1;             // 1/s: <force_approximation_scaling_factor>
};

// Lifts bodies with the weight of what they displace, at the centre of the displaced volume:
// Gazebo's Buoyancy.
struct Fluid {
  struct Layer {
    double above = 0;    // m: the layer begins at this height
    double density = 0;  // kg/m³
  };
  double density = 1000;      // kg/m³, below all layers
  std::vector<Layer> layers;  // by height, ascending; each ends where the next begins
  // Models ("boat") and links ("boat::hull") that are lifted; empty: all.
  std::vector<std::string> lifted;
};

}  // namespace gsv::model
