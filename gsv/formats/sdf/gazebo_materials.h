// Provides Gazebo's built-in materials by name, such as "Gazebo/Grey".
#pragma once

#include <optional>
#include <string_view>

#include "gsv/model/material.h"

namespace gsv::formats {

// Returns the material; nullopt for an unknown name. Textured materials (Wood, Bricks, Grass, …)
// have the mean colour of their image.
std::optional<model::Material> GazeboMaterial(std::string_view name);

}  // namespace gsv::formats
