// A world that is a single model, as it is read if a model is given as a world.
#pragma once

#include "gsv/model/world_description.h"

namespace gsv::app {

// Whether a world is a single model, with at most a ground besides.
bool IsModelAlone(const model::WorldDescription& world);
// Places such a model on the ground, since the origin of a model may be anywhere in it.
void StandModelOnGround(model::WorldDescription& world);

}  // namespace gsv::app
