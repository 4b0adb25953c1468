#include "gsv/world/actuator_state.h"

namespace gsv::world {

void ActuatorState::AddToHash(base::Hash& hash) const {
  hash.Add(std::string_view(robot()));
  hash.Add(std::string_view(device()));
  hash.Add(static_cast<std::int64_t>(since().count()));
  hash.Add(static_cast<std::uint64_t>(values().size()));
  for (const double value : values()) hash.Add(value);
  hash.Add(std::string_view(word()));
  AddRestToHash(hash);
}

void ActuatorState::AddGraspToHash(double opening_before, const Grasp& grasp, double width,
                                   base::Hash& hash) {
  hash.Add(opening_before);
  hash.Add(std::string_view(grasp.held));
  const geometry::Pose& pose = grasp.link_from_held;
  const geometry::Quaternion& q = pose.orientation;
  for (const double value :
       {pose.position.x, pose.position.y, pose.position.z, q.w, q.x, q.y, q.z, width}) {
    hash.Add(value);
  }
}

}  // namespace gsv::world
