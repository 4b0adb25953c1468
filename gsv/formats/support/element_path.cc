#include "gsv/formats/support/element_path.h"

#include <string_view>

namespace gsv::formats {

std::string PathOf(const tinyxml2::XMLElement& element) {
  std::string path;
  for (const tinyxml2::XMLNode* node = &element; node != nullptr; node = node->Parent()) {
    const tinyxml2::XMLElement* each = node->ToElement();
    if (each == nullptr || std::string_view(each->Name()) == "sdf") continue;
    std::string part = each->Name();
    const char* name = each->Attribute(part == "gazebo" ? "reference" : "name");
    if (name != nullptr && part != "world") part += "[" + std::string(name) + "]";
    path = path.empty() ? part : part + "/" + path;
  }
  return path;
}

}  // namespace gsv::formats
