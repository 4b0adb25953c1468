// Built-in copies of models that worlds often include by a web address.
#pragma once

#include <string_view>

namespace gsv::formats {

// Returns the SDFormat text for the last part of a web address or of a model:// name: Ground Plane
// (a <model>) or Sun (a <light>), in any spelling. Empty for any other name.
std::string_view BuiltInModel(std::string_view uri);

// Returns a world with a ground plane and a sun, or only with a sun.
std::string_view EnvironmentWorld(bool with_ground_plane);

}  // namespace gsv::formats
