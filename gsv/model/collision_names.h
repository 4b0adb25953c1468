// Finds the collisions that a contact sensor names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/model/model.h"

namespace gsv::model {

// Indices in Model::links and in Link::collisions.
struct CollisionIndex {
  int link = 0;
  int collision = 0;
  friend bool operator==(const CollisionIndex&, const CollisionIndex&) = default;
};

// The name of the contact sensor's parameter that lists collisions, one per line. An empty list
// means all collisions.
inline constexpr const char* kCollisionNames = "collision";

// Returns the names in the sensor's description, without SDFormat's "__default__".
std::vector<std::string> CollisionNamesOf(const SensorDescription& sensor);

// Returns the collision with that name for a sensor on `link`. Searches this link before the other
// links. The name may be scoped ("base::bumper", "robot::base::bumper"). It may also be the name
// that Gazebo gives to a collision of a merged link ("base_fixed_joint_lump__bumper_collision_1").
// Returns nullopt if there is no such collision.
std::optional<CollisionIndex> FindCollision(const Model& model, int link, std::string_view name);

}  // namespace gsv::model
