#include "gsv/presentation/pose_list.h"

namespace gsv::presentation {

std::vector<PoseEntry> PoseListOf(const world::Layout& layout) {
  std::vector<PoseEntry> list;
  for (int body = 0; body < static_cast<int>(layout.bodies.size()); ++body) {
    if (layout.bodies[body].is_static()) continue;
    list.push_back({body, -1});
    for (const int link : world::MovingLinks(*layout.bodies[body].model)) {
      list.push_back({body, link});
    }
  }
  return list;
}

std::vector<geometry::Pose> PosesOf(const world::Snapshot& snapshot,
                                    const std::vector<PoseEntry>& list) {
  std::vector<geometry::Pose> poses;
  poses.reserve(list.size());
  for (const PoseEntry& entry : list) {
    const geometry::Pose& world_from_model = snapshot.state.bodies[entry.body].world_from_model;
    poses.push_back(entry.link < 0 ? world_from_model
                                   : world_from_model *
                                         world::ModelFromLink(snapshot, entry.body, entry.link));
  }
  return poses;
}

}  // namespace gsv::presentation
