// OGRE material scripts, as far as Gazebo's models use them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "gsv/model/material.h"

namespace gsv::formats {

// What the first pass of a material says; absent where it says nothing.
struct OgreMaterial {
  std::optional<model::Colour> ambient, diffuse, specular, emissive;
  double shininess = 0;
  std::string texture;  // of the first texture unit
};

// The materials of a script by name. Reads `material NAME [: PARENT] { technique { pass { … } } }`,
// of a pass the four colours, and `texture` of the first texture unit; whatever else is there is
// passed over, and a script that ends early yields what it has. A parent's values are inherited.
std::map<std::string, OgreMaterial> ParseOgreMaterials(std::string_view script);

}  // namespace gsv::formats
