// Reads the material of an SDFormat <visual>.
#pragma once

#include <optional>

#include <sdf/Visual.hh>

#include "gsv/formats/sdf/reading_context.h"

namespace gsv::formats {

// The visual's own material; none if it has none, or an empty one. Colours: <diffuse>, else the
// script's, else <ambient>. A script's name is searched in its <uri>s, then among Gazebo's own.
// Transparency is not applied.
std::optional<model::Material> ReadVisualMaterial(const sdf::Visual& visual,
                                                  const ReadingContext& context);

}  // namespace gsv::formats
