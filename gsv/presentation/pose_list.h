// Lists the poses of gsv_msgs/Poses in their order.
#pragma once

#include <vector>

#include "gsv/world/snapshot.h"

namespace gsv::presentation {

// One entry of the list: the pose of a body (link -1: world_from_model), or of a link that moves
// relative to its body (world_from_link).
struct PoseEntry {
  int body = 0;   // index in Layout::bodies
  int link = -1;  // index in Model::links
  friend bool operator==(const PoseEntry&, const PoseEntry&) = default;
};

// Lists each non-static body in the order of the layout, followed by its moving links.
std::vector<PoseEntry> PoseListOf(const world::Layout& layout);

// Returns the pose of each entry. `list` must be PoseListOf() for the snapshot's layout.
std::vector<geometry::Pose> PosesOf(const world::Snapshot& snapshot,
                                    const std::vector<PoseEntry>& list);

}  // namespace gsv::presentation
