// Finds the wheels of a model by their shapes, to guess and measure drives.
//
// Frames  the model's, at zero joint positions.
// Units   metres.
#pragma once

#include <optional>
#include <vector>

#include "gsv/model/model.h"

namespace gsv::model {

// A link that is round about the axis of its joint.
struct Wheel {
  int joint = 0;  // the joint of the wheel; an index in Model::joints, like the other joints below
  geometry::Vector3 centre;
  geometry::Vector3 axis;     // unit length
  double radius = 0;          // 0 if the link has no shape
  std::optional<int> swivel;  // the vertical joint between wheel and base, if any
};

// Whether a joint can rotate without a limit: it is continuous, or revolute with a range of several
// revolutions.
bool TurnsFreely(const Joint& joint);

// Returns the wheel on a joint, measured on its collisions, or on its visuals if only these are
// round. Returns nullopt if neither are round about the joint's axis. Links that are fixed to the
// wheel's link are parts of it.
std::optional<Wheel> MeasureWheel(const Model& model, int joint);

// Returns all wheels that may carry the model, in the order of the joints. Such wheels are on
// joints that turn freely about a level axis, and they touch level ground below the model. A link
// without any shape counts if IsNamed() finds "wheel".
std::vector<Wheel> FindWheels(const Model& model);

// Whether the name of the wheel's joint, link or swivel contains one of these words, in upper or
// lower case.
bool IsNamed(const Model& model, const Wheel& wheel, std::initializer_list<const char*> words);

}  // namespace gsv::model
