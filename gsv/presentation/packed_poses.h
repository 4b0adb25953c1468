// Makes the message gsv_msgs/PackedPoses: all poses in fewer bytes than gsv_msgs/Poses.
#pragma once

#include <vector>

#include "gsv/messages/gsv_msgs.h"
#include "gsv/presentation/pose_list.h"

namespace gsv::presentation {

// `list` must be PoseListOf() for the snapshot's layout. Positions are rounded to 0.1 mm. An
// orientation is changed by a rotation of less than 0.0002 rad.
messages::gsv_msgs::PackedPoses PackedPosesMessage(const world::Snapshot& snapshot,
                                                   const std::vector<PoseEntry>& list);

}  // namespace gsv::presentation
