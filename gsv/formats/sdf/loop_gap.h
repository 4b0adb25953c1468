// The distance between the two ends of a joint that closes a loop, at the initial joint positions.
#pragma once

#include "gsv/model/model.h"

namespace gsv::formats {

// Returns the gap in m between the two ends of a joint of Model::loop_joints. The distance along
// the axis of a prismatic joint does not count. If all initial positions are zero, the gap is 0,
// because the file defines the joint at these positions.
double LoopGap(const model::Model& model, const model::Joint& loop);

}  // namespace gsv::formats
