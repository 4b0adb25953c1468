// Fuzz test: expands the input as a xacro file. It must be refused with a sentence, or the result
// must be XML.
#include "gsv/base/check.h"
#include "gsv/formats/fuzz/scratch_file.h"
#include "gsv/formats/xacro/xacro.h"

using namespace gsv;

static std::size_t Elements(const tinyxml2::XMLElement& element) {
  std::size_t count = 1;
  for (auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    count += Elements(*child);
  }
  return count;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tinyxml2::XMLDocument document;
  if (document.Parse(reinterpret_cast<const char*>(data), size) != tinyxml2::XML_SUCCESS ||
      document.RootElement() == nullptr) {
    return 0;
  }
  static const formats::ResourceFinder finder({}, false);
  formats::ReadLimits limits;
  limits.xml_bytes = 1u << 20;
  base::Problems problems;
  const auto file = formats::ScratchFile("input.xacro", data, size);
  const auto expanded =
      formats::xacro::Expand(*document.RootElement(), file, {finder, limits, {}}, problems);
  if (!expanded) {
    GSV_CHECK(!expanded.error().message.empty() && !expanded.error().where.empty());
    return 0;
  }
  tinyxml2::XMLDocument plain;
  const auto status = plain.Parse(expanded->xml.data(), expanded->xml.size());
  GSV_CHECK(status == tinyxml2::XML_SUCCESS || status == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED);
  if (status == tinyxml2::XML_SUCCESS) {
    GSV_CHECK(Elements(*plain.RootElement()) == expanded->sources.size());
  }
  return 0;
}
