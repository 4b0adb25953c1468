// What a world has besides models: light, look, physics.
#pragma once

#include <sdf/Light.hh>
#include <sdf/World.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// Its pose is the caller's.
model::Light ReadLight(const sdf::Light& source, const ReadingContext& context);

// Gravity, physics and scene; models and lights are the caller's.
void ReadSurroundings(const sdf::World& source, const ReadingContext& context,
                      model::WorldDescription& world);

}  // namespace gsv::formats
