#include "gsv/formats/sdf/builtin_models.h"

#include <cctype>
#include <string>

namespace gsv::formats {
namespace {

#define GSV_GROUND_PLANE                                                      \
  "<model name='ground_plane'><static>true</static><link name='link'>"        \
  "<collision name='collision'><geometry><plane><normal>0 0 1</normal>"       \
  "<size>100 100</size></plane></geometry></collision>"                       \
  "<visual name='visual'><cast_shadows>false</cast_shadows><geometry><plane>" \
  "<normal>0 0 1</normal><size>100 100</size></plane></geometry><material>"   \
  "<ambient>0.8 0.8 0.8 1</ambient><diffuse>0.8 0.8 0.8 1</diffuse>"          \
  "<specular>0.1 0.1 0.1 1</specular></material></visual></link></model>"

#define GSV_SUN                                                            \
  "<light name='sun' type='directional'><cast_shadows>true</cast_shadows>" \
  "<pose>0 0 10 0 0 0</pose><diffuse>0.8 0.8 0.8 1</diffuse>"              \
  "<specular>0.2 0.2 0.2 1</specular><direction>-0.5 0.1 -0.9</direction></light>"

constexpr std::string_view kGroundPlane = GSV_GROUND_PLANE;
constexpr std::string_view kSun = GSV_SUN;
constexpr std::string_view kSunlitWorld =
    "<sdf version='1.9'><world name='default'>" GSV_SUN "</world></sdf>";
constexpr std::string_view kGroundAndSunWorld =
    "<sdf version='1.9'><world name='default'>" GSV_GROUND_PLANE GSV_SUN "</world></sdf>";

#undef GSV_GROUND_PLANE
#undef GSV_SUN

// Maps "Ground%20Plane", "ground_plane" and "Ground Plane/2" to one name.
std::string PlainName(std::string_view uri) {
  while (!uri.empty() &&
         (uri.back() == '/' || std::isdigit(static_cast<unsigned char>(uri.back())))) {
    uri.remove_suffix(1);
  }
  std::string name;
  for (std::size_t i = uri.rfind('/') + 1; i < uri.size(); ++i) {
    const auto c = static_cast<unsigned char>(uri[i]);
    if (uri.substr(i, 3) == "%20") {
      i += 2;
    } else if (c != ' ' && c != '_' && c != '-') {
      name += static_cast<char>(std::tolower(c));
    }
  }
  return name;
}

}  // namespace

std::string_view BuiltInModel(std::string_view uri) {
  const std::string name = PlainName(uri);
  if (name == "groundplane") return kGroundPlane;
  if (name == "sun") return kSun;
  return {};
}

std::string_view EnvironmentWorld(bool with_ground_plane) {
  return with_ground_plane ? kGroundAndSunWorld : kSunlitWorld;
}

}  // namespace gsv::formats
