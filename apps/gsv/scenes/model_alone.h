// Worlds that consist of one model. gsv makes such a world if the user gives a model as the world.
#pragma once

#include "gsv/model/world_description.h"

namespace gsv::app {

// Whether a world consists of a single model, or of a single model and a ground.
bool IsModelAlone(const model::WorldDescription& world);
// Places the model of such a world on the ground. The origin of a model may be anywhere, so its
// lowest visible point is used.
void StandModelOnGround(model::WorldDescription& world);

}  // namespace gsv::app
