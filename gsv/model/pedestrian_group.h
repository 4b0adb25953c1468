// A group of pedestrians: `<gsv:pedestrians>` in a world file, or `pedestrians` in a scenario.
//
// Units  metres, seconds, the world's frame.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/geometry/vector3.h"
#include "gsv/model/model.h"

namespace gsv::model {

// A goal: a random point in a disc, different each time.
struct PedestrianGoal {
  double x = 0, y = 0;
  double radius = 0;  // radius of the disc; 0 for exactly this point
  friend bool operator==(const PedestrianGoal&, const PedestrianGoal&) = default;
};

// Pedestrians with the same route, speed and size.
struct PedestrianGroup {
  std::string name = "pedestrian";  // pedestrians are called NAME_1, NAME_2, …
  int count = 1;
  // The goals in their order. After the last goal, the route begins again at the first goal. If
  // there is a single goal, pedestrians stay within its disc. There is no path planning, so each
  // goal must be in sight of the previous goal.
  std::vector<PedestrianGoal> route;
  double z = 0;                                 // height of the floor
  double speed = 1.34, speed_deviation = 0.26;  // in m/s; desired speeds have a normal distribution
  double radius = 0.25, height = 1.75;          // size of the collision cylinder

  friend bool operator==(const PedestrianGroup&, const PedestrianGroup&) = default;
};

inline constexpr int kMaxPedestrians = 100'000;  // maximum number in a group and in a world

// Rejects groups without a name or without goals, and numbers that are out of range or not finite
// (kInvalidArgument).
base::Status Check(const PedestrianGroup& group);

// Returns the model of a pedestrian: a simple figure that faces along x, with its feet at z = 0, in
// one of kPedestrianLooks colourings, and a collision cylinder.
inline constexpr int kPedestrianLooks = 8;
std::shared_ptr<const Model> PedestrianModel(const PedestrianGroup& group, int look);

}  // namespace gsv::model
