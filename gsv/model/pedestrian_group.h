// People of one kind who walk about in a world: `<gsv:pedestrians>` of a world's file, and
// `pedestrians` of a scenario.
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

// A place to walk to: anywhere within a disc, each time elsewhere.
struct PedestrianGoal {
  double x = 0, y = 0;
  double radius = 0;
  friend bool operator==(const PedestrianGoal&, const PedestrianGoal&) = default;
};

struct PedestrianGroup {
  std::string name = "pedestrian";  // its members are NAME_1, NAME_2, …
  int count = 1;
  // Visited one after the other, and again from the first; one alone is stayed within. Nobody looks
  // for a way: each goal must be in sight of the one before.
  std::vector<PedestrianGoal> route;
  double z = 0;                                 // of the floor
  double speed = 1.34, speed_deviation = 0.26;  // m/s: desired speeds are normally distributed
  double radius = 0.25, height = 1.75;          // of the cylinder that others run into

  friend bool operator==(const PedestrianGroup&, const PedestrianGroup&) = default;
};

inline constexpr int kMaxPedestrians = 100'000;  // of a group

// Refuses (kInvalidArgument) what makes no sense: no goals, a count or size that is out of range,
// numbers that are not finite.
base::Status Check(const PedestrianGroup& group);

// The model of a member: a simple person who faces along x, with its feet at z = 0, in one of
// kPedestrianLooks suits of clothes, and a cylinder to run into.
inline constexpr int kPedestrianLooks = 8;
std::shared_ptr<const Model> PedestrianModel(const PedestrianGroup& group, int look);

}  // namespace gsv::model
