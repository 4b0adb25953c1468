#include "gsv/formats/sdf/sdf_schema.h"

#include <map>
#include <memory>
#include <string>

#include <tinyxml2.h>
#include <sdf/Param.hh>
#include <sdf/SDFImpl.hh>

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;

std::string AttributeText(const XMLElement& element, const char* name) {
  const char* text = element.Attribute(name);
  return text == nullptr ? "" : text;
}

std::string DescriptionText(const XMLElement& element) {
  const XMLElement* description = element.FirstChildElement("description");
  return description == nullptr || description->GetText() == nullptr ? "" : description->GetText();
}

bool IsRequired(const XMLElement& element) { return AttributeText(element, "required") == "1"; }

// Builds descriptions from the files of the schema. A file has one <element>, which contains
// <attribute>, <element> and <include>. An <include> refers to the element of another file.
class SchemaBuilder {
 public:
  explicit SchemaBuilder(const std::set<std::string>& without) : without_(without) {}

  // Returns the description in a file of the schema; null if there is no such file.
  sdf::ElementPtr FromFile(const std::string& file) {
    const auto known = elements_.find(file);
    if (known != elements_.end()) return known->second;
    return elements_[file] = Unshared(file);
  }

 private:
  sdf::ElementPtr Unshared(const std::string& file) {
    tinyxml2::XMLDocument document(true, tinyxml2::COLLAPSE_WHITESPACE);
    document.Parse(sdf::SDF::EmbeddedSpec(file, true).c_str());
    const XMLElement* root = document.FirstChildElement("element");
    return root == nullptr ? nullptr : FromElement(*root);
  }

  sdf::ElementPtr FromElement(const XMLElement& xml) {
    const auto element = std::make_shared<sdf::Element>();
    if (xml.Attribute("ref") != nullptr) element->SetReferenceSDF(AttributeText(xml, "ref"));
    element->SetName(AttributeText(xml, "name"));
    element->SetRequired(AttributeText(xml, "required"));
    const std::string description = DescriptionText(xml);
    if (xml.Attribute("type") != nullptr) {
      element->AddValue(AttributeText(xml, "type"), AttributeText(xml, "default"), IsRequired(xml),
                        AttributeText(xml, "min"), AttributeText(xml, "max"), description);
    }
    AddAttributes(xml, *element);
    element->SetDescription(description);
    AddElements(xml, *element);
    AddIncludes(xml, *element);
    return element;
  }

  static void AddAttributes(const XMLElement& xml, sdf::Element& element) {
    for (auto* each = xml.FirstChildElement("attribute"); each != nullptr;
         each = each->NextSiblingElement("attribute")) {
      element.AddAttribute(AttributeText(*each, "name"), AttributeText(*each, "type"),
                           AttributeText(*each, "default"), IsRequired(*each),
                           DescriptionText(*each));
    }
  }

  void AddElements(const XMLElement& xml, sdf::Element& element) {
    for (auto* each = xml.FirstChildElement("element"); each != nullptr;
         each = each->NextSiblingElement("element")) {
      const std::string copies = AttributeText(*each, "copy_data");
      if (copies == "true" || copies == "1") {
        element.SetCopyChildren(true);
      } else if (!without_.contains(AttributeText(*each, "name"))) {
        element.AddElementDescription(FromElement(*each));
      }
    }
  }

  void AddIncludes(const XMLElement& xml, sdf::Element& element) {
    for (auto* each = xml.FirstChildElement("include"); each != nullptr;
         each = each->NextSiblingElement("include")) {
      const std::string file = AttributeText(*each, "filename");
      const std::string description = DescriptionText(*each);
      const sdf::ElementPtr included = description.empty() ? FromFile(file) : Unshared(file);
      if (included == nullptr || without_.contains(included->GetName())) continue;
      if (!description.empty()) included->SetDescription(description);
      element.AddElementDescription(included);
    }
  }

  const std::set<std::string>& without_;
  std::map<std::string, sdf::ElementPtr> elements_;  // by file
};

}  // namespace

sdf::ElementPtr MakeSdfSchema(const std::set<std::string>& without) {
  return SchemaBuilder(without).FromFile("root.sdf");
}

sdf::ElementPtr DescriptionInFile(const std::string& file) {
  static const std::set<std::string> nothing;
  static SchemaBuilder builder(nothing);
  return builder.FromFile(file);
}

}  // namespace gsv::formats
