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
  std::vector<geometry::Pose> links;  // link poses of the body with the index `links_of`
  int links_of = -1;
  for (const PoseEntry& entry : list) {
    if (entry.link < 0) {
      poses.push_back(snapshot.state.bodies[entry.body].world_from_model);
      continue;
    }
    if (links_of != entry.body) {
      links = world::LinkPoses(snapshot, entry.body);
      links_of = entry.body;
    }
    poses.push_back(links[entry.link]);
  }
  return poses;
}

}  // namespace gsv::presentation
