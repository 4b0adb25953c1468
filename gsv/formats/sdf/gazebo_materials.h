// Gazebo's own materials by name, such as "Gazebo/Grey".
#pragma once

#include <optional>
#include <string_view>

#include "gsv/model/material.h"

namespace gsv::formats {

// Textured ones (Wood, Bricks, Grass, …) have their picture's mean colour.
std::optional<model::Material> GazeboMaterial(std::string_view name);

}  // namespace gsv::formats
