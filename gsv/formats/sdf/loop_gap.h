// The distance between the two ends of a joint that closes a loop, at the initial joint positions.
#pragma once

#include "gsv/model/model.h"

namespace gsv::formats {

// Returns the gap in m of a joint of Model::loop_joints. A prismatic joint may have any distance
// along its axis. The gap is 0 if all initial positions are zero, as the file defines the joint
// there.
double LoopGap(const model::Model& model, const model::Joint& loop);

}  // namespace gsv::formats
