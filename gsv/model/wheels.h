// Finds the wheels of a model by their shape: what drives are guessed and measured from.
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
  int joint = 0;  // turns the wheel; an index into Model::joints, as all below
  geometry::Vector3 centre;
  geometry::Vector3 axis;     // unit length
  double radius = 0;          // 0: the link has no shape
  std::optional<int> swivel;  // the joint about the vertical between wheel and base, if any
};

// Whether a joint turns without end: continuous, or revolute with a range of several turns.
bool TurnsFreely(const Joint& joint);

// The wheel on that joint, measured on its collisions, or on its visuals where these are round and
// the collisions are not. None where neither is round about the joint's axis. Links that are fixed
// to the wheel's link count as parts of it.
std::optional<Wheel> MeasureWheel(const Model& model, int joint);

// All wheels that may carry the model: on joints that turn freely about a level axis, and touching
// the ground on which the model's lowest collision stands. A link without any shape counts when its
// name or its joint's says "wheel". In the order of the joints.
std::vector<Wheel> FindWheels(const Model& model);

// Whether the name of the joint, of its child link or of its swivel contains one of these words,
// in any case.
bool IsNamed(const Model& model, const Wheel& wheel, std::initializer_list<const char*> words);

}  // namespace gsv::model
