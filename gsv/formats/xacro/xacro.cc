#include "gsv/formats/xacro/xacro.h"

#include <string_view>

#include "gsv/formats/xacro/expander.h"

namespace gsv::formats::xacro {

bool NeedsExpansion(const tinyxml2::XMLElement& root, const std::filesystem::path& file) {
  if (file.extension() == ".xacro") return true;
  for (auto* child = root.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (std::string_view(child->Name()).starts_with("xacro:")) return true;
    if (NeedsExpansion(*child, file)) return true;
  }
  return false;
}

base::Result<Expansion> Expand(const tinyxml2::XMLElement& root, const std::filesystem::path& file,
                               const ExpandOptions& options, base::Problems& problems) {
  Expander expander(options, problems);
  const auto expanded = expander.Run(ToNode(root, std::make_shared<std::filesystem::path>(file)));
  if (!expanded) return base::Fail(expanded.error());
  Expansion expansion = ToXml(**expanded, options.limits.xml_bytes);
  if (expansion.xml.size() > options.limits.xml_bytes) {
    return base::Fail(base::ErrorCode::kBadModel,
                      "the expanded file is larger than the limit of " +
                          std::to_string(options.limits.xml_bytes) + " bytes",
                      file.string());
  }
  return expansion;
}

}  // namespace gsv::formats::xacro
