// Reads the material of an SDFormat <visual>.
#pragma once

#include <optional>

#include <sdf/Visual.hh>

#include "gsv/formats/sdf/reading_context.h"

namespace gsv::formats {

// Reads the visual's own material. Returns nullopt if the visual has no material, or an empty
// material. The colour is <diffuse>, else the colour of the material script, else <ambient>. The
// name of a script is searched in the files of its <uri>s, then among Gazebo's materials.
// <transparency> is not applied.
std::optional<model::Material> ReadVisualMaterial(const sdf::Visual& visual,
                                                  const ReadingContext& context);

}  // namespace gsv::formats
