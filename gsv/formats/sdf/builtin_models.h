// Models that worlds include from the web and that this program therefore knows by itself.
#pragma once

#include <string_view>

namespace gsv::formats {

// SDFormat text of what the last part of a web address or of a model:// name stands for: Ground
// Plane (a <model>) or Sun (a <light>), however it is spelt; empty for any other.
std::string_view BuiltInModel(std::string_view uri);

// A world with a ground plane and a sun, or with the sun alone.
std::string_view EnvironmentWorld(bool with_ground_plane);

}  // namespace gsv::formats
