// Reads a <joint>: its kind, axes, limits, damping and friction.
//
// A joint with several axes becomes a chain of joints from parent to child, with links without mass
// or shape between them. A universal (or revolute2) joint "j" becomes "j" and "j::axis2" with the
// link "j::cross" between them. A ball joint becomes "j", "j::axis2" and "j::axis3", about the z, y
// and x axes of its frame, with "j::cross" and "j::cross2".
#pragma once

#include <string>

#include <sdf/Joint.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Adds the joint that `source` describes to `model`. `joint` already has its name, links and frame.
// `place` is the place for messages. A zero axis and inverted limits are repaired and reported as
// problems.
void AddJoint(const sdf::Joint& source, model::Joint joint, const std::string& place,
              const ReadingContext& context, model::Model& model);

}  // namespace gsv::formats
