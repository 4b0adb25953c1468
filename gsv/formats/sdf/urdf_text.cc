#include "gsv/formats/sdf/urdf_text.h"

#include <map>

#include "gsv/formats/sdf/urdf_repair.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using tinyxml2::XMLElement;

constexpr int kMostPasses = 8;  // a property may name another

using Values = std::map<std::string, std::string>;  // "${NAME}" or "$(arg NAME)" and its value

base::Status CollectValues(XMLElement& element, const std::filesystem::path& path, Values& values) {
  XMLElement* next = nullptr;
  for (auto* child = element.FirstChildElement(); child != nullptr; child = next) {
    next = child->NextSiblingElement();
    const std::string name = child->Name();
    const char* key = child->Attribute("name");
    if (name == "xacro:property" && key != nullptr && child->Attribute("value") != nullptr) {
      values["${" + std::string(key) + "}"] = child->Attribute("value");
    } else if (name == "xacro:arg" && key != nullptr) {
      const char* value = child->Attribute("default");
      values["$(arg " + std::string(key) + ")"] = value == nullptr ? "" : value;
    } else if (name.rfind("xacro:", 0) == 0) {
      return Fail(ErrorCode::kBadModel, "<" + name + "> needs xacro: run `xacro FILE > robot.urdf`",
                  PlaceOf(path, *child));
    } else {
      if (auto status = CollectValues(*child, path, values); !status) return status;
      continue;
    }
    element.DeleteChild(child);
  }
  return {};
}

std::string Substitute(std::string text, const Values& values) {
  for (int pass = 0; pass < kMostPasses && text.find('$') != std::string::npos; ++pass) {
    for (const auto& [key, value] : values) {
      for (std::size_t at = text.find(key); at != std::string::npos;
           at = text.find(key, at + value.size())) {
        text.replace(at, key.size(), value);
      }
    }
  }
  return text;
}

void Fill(XMLElement& element, const Values& values) {
  for (auto* attribute = element.FirstAttribute(); attribute != nullptr;
       attribute = attribute->Next()) {
    const std::string value = attribute->Value();
    if (value.find('$') == std::string::npos) continue;
    element.SetAttribute(attribute->Name(), Substitute(value, values).c_str());
  }
  for (auto* child = element.FirstChild(); child != nullptr; child = child->NextSibling()) {
    if (auto* inner = child->ToElement()) {
      Fill(*inner, values);
    } else if (auto* text = child->ToText()) {
      text->SetValue(Substitute(text->Value(), values).c_str());
    }
  }
}

}  // namespace

base::Result<std::string> UrdfText(const XmlFile& file, base::Problems& problems) {
  Values values;
  if (auto status = CollectValues(*file.root, file.path, values); !status) {
    return Fail(status.error());
  }
  Fill(*file.root, values);
  RepairUrdf(*file.root, file.path, problems);
  LineKeepingPrinter printer;
  printer.Text("<?xml version='1.0'?>");
  printer.Element(*file.root);
  return printer.Take();
}

}  // namespace gsv::formats
