// Reads a <joint>: its kind, axes, limits and losses.
//
// A joint with several axes becomes several in a row, from parent to child, between which hang
// links without mass or shape: a universal (or revolute2) joint "j" is "j" and "j::axis2" with the
// link "j::cross" between them; a ball joint is three, "j", "j::axis2" and "j::axis3", about the z,
// y and x axes of its frame, with "j::cross" and "j::cross2".
#pragma once

#include <string>

#include <sdf/Joint.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Adds to `model` what `source` describes. `joint` has its name, links and frame already; `place`
// is for messages. An axis that is none, and limits that are the wrong way round, are repaired and
// complained of.
void AddJoint(const sdf::Joint& source, model::Joint joint, const std::string& place,
              const ReadingContext& context, model::Model& model);

}  // namespace gsv::formats
