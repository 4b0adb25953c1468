// Reads the parts of a world that are not models: lights, scene, physics.
#pragma once

#include <sdf/Light.hh>
#include <sdf/World.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// Reads a light; the caller sets its pose.
model::Light ReadLight(const sdf::Light& source, const ReadingContext& context);

// Reads gravity, physics and scene; the caller reads models and lights.
void ReadPhysicsAndScene(const sdf::World& source, const ReadingContext& context,
                         model::WorldDescription& world);

}  // namespace gsv::formats
