#include "gsv/formats/sdf/shared_descriptions.h"

#include <memory>
#include <stdexcept>

#include <sdf/Element.hh>
#include <sdf/Param.hh>
#include <sdf/parser.hh>

#include "gsv/formats/sdf/sdf_schema.h"

// The linker option --undefined requests this symbol, so that the linker includes this file.
extern "C" const char gsv_shared_descriptions = 0;

namespace {

sdf::ParamPtr CloneFor(const sdf::ElementPtr& owner, const sdf::Param& original) {
  const sdf::ParamPtr clone = original.Clone();
  if (!clone->SetParentElement(owner)) {
    throw std::logic_error("internal error: the copied value of the SDFormat parameter " +
                           original.GetKey() + " cannot be parsed");
  }
  return clone;
}

}  // namespace

// Does the same as libsdformat 12's definition, but does not clone the descriptions. This is safe,
// because libsdformat does not change them: it fills clones, and never calls Element::Reset(),
// which clears descriptions.
sdf::ElementPtr sdf::Element::Clone() const {
  const ElementPrivate& from = *dataPtr;
  const ElementPtr clone = std::make_shared<Element>();
  ElementPrivate& to = *clone->dataPtr;
  to.description = from.description;
  to.name = from.name;
  to.required = from.required;
  to.copyChildren = from.copyChildren;
  to.referenceSDF = from.referenceSDF;
  to.path = from.path;
  to.lineNumber = from.lineNumber;
  to.xmlPath = from.xmlPath;
  to.originalVersion = from.originalVersion;
  to.explicitlySetInFile = from.explicitlySetInFile;
  to.attributes.reserve(from.attributes.size());
  for (const ParamPtr& attribute : from.attributes) {
    to.attributes.push_back(CloneFor(clone, *attribute));
  }
  to.elementDescriptions = from.elementDescriptions;
  to.elements.reserve(from.elements.size());
  for (const ElementPtr& element : from.elements) {
    to.elements.push_back(element->Clone());
    to.elements.back()->SetParent(clone);
  }
  if (from.value != nullptr) to.value = CloneFor(clone, *from.value);
  if (from.includeElement != nullptr) to.includeElement = from.includeElement->Clone();
  return clone;
}

// libsdformat calls this for each file of the schema, each <include> in these files, and each
// nested model. Its own definition would parse the file and all files that it includes.
bool sdf::initFile(const std::string& file, ElementPtr element) {
  const ElementPtr description = gsv::formats::DescriptionInFile(file);
  if (description == nullptr) return false;
  element->Copy(description);
  return true;
}

bool gsv::formats::SharesDescriptions() {
  const auto owner = std::make_shared<sdf::Element>();
  const auto described = std::make_shared<sdf::Element>();
  const auto below = std::make_shared<sdf::Element>();
  described->SetName("described");
  described->AddElementDescription(below);
  owner->AddElementDescription(described);
  return owner->AddElement("described")->GetElementDescription(0U) == below;
}
