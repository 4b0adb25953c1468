// Models on the web that worlds often include, and that are therefore built in.
#pragma once

#include <string_view>

namespace gsv::formats {

// SDFormat text for the last part of a web address or of a model:// name: Ground Plane (a <model>)
// or Sun (a <light>), in any spelling; empty for any other.
std::string_view BuiltInModel(std::string_view uri);

// A world with a ground plane and a sun, or only with a sun.
std::string_view EnvironmentWorld(bool with_ground_plane);

}  // namespace gsv::formats
