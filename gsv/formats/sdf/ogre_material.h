// Reads OGRE material scripts, as far as Gazebo's models use them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "gsv/model/material.h"

namespace gsv::formats {

// The values of a material's first pass, including those inherited from its parent. A colour or
// texture that neither sets is empty; the shininess is then 0.
struct OgreMaterial {
  std::optional<model::Colour> ambient, diffuse, specular, emissive;
  double shininess = 0;
  std::string texture;  // file of the texture in the first texture unit
};

// Returns the materials of a script by name. Reads `material NAME [: PARENT] { technique { pass { …
// } } }` with the four colours of a pass, and `texture` of the first texture unit. Ignores all
// other parts. A truncated script gives the materials before its end. Materials inherit their
// parent's values.
std::map<std::string, OgreMaterial> ParseOgreMaterials(std::string_view script);

}  // namespace gsv::formats
