#include "gsv/formats/support/element_path.h"

#include <string_view>

namespace gsv::formats {

std::string PlaceOf(const std::filesystem::path& file, const tinyxml2::XMLNode& node) {
  const auto* source = static_cast<const ElementSource*>(node.GetUserData());
  if (source != nullptr) return source->file->string() + ":" + std::to_string(source->line);
  return file.string() + ":" + std::to_string(node.GetLineNum());
}

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
