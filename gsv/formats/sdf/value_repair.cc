#include "gsv/formats/sdf/value_repair.h"

#include <cstring>
#include <set>
#include <string>

#include <sdf/Element.hh>
#include <sdf/Param.hh>

#include "gsv/formats/sdf/sdf_document.h"
#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/formats/sdf/value_text.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;

constexpr char kNoDefault[] = "__default__";

sdf::ElementPtr Schema() {
  const base::MutexLock lock(SdformatMutex());
  SilenceConsoles();
  return SdfSchema();
}

// Returns the description of a child element. A nested model has the same description as any other
// model.
sdf::ElementPtr DescriptionOf(const char* name, const sdf::ElementPtr& parent) {
  if (parent == nullptr || !parent->HasElementDescription(name)) return nullptr;
  if (std::strcmp(name, "model") == 0 && parent->GetName() == "model") {
    return Schema()->GetElementDescription("model");
  }
  return parent->GetElementDescription(name);
}

bool IsBlank(const XMLElement* element) {
  return element == nullptr || element->GetText() == nullptr || WordsOf(element->GetText()).empty();
}

std::string Tag(const XMLElement& element) { return "<" + std::string(element.Name()) + ">"; }

std::string NameOf(const XMLElement& element) {
  const char* name = element.Attribute("name");
  return Tag(element) + (name == nullptr ? "" : " \"" + std::string(name) + "\"");
}

class ValueRepair {
 public:
  ValueRepair(const std::filesystem::path& file, base::Problems& problems)
      : file_(file), problems_(problems) {}

  void Visit(XMLElement& element, const sdf::ElementPtr& description) {
    RepairAttributes(element, description);
    RepairOwnText(element, description);
    KeepAutomaticInertia(element);
    XMLElement* next = nullptr;
    for (auto* child = element.FirstChildElement(); child != nullptr; child = next) {
      next = child->NextSiblingElement();
      const sdf::ElementPtr of_child = DescriptionOf(child->Name(), description);
      if (of_child == nullptr || IsLeftOut(*child)) continue;
      Visit(*child, of_child);
    }
  }

 private:
  void Warn(const XMLElement& element, const std::string& message) {
    problems_.push_back({base::Problem::Severity::kWarning, message, PlaceOf(file_, element)});
  }

  // Copies @auto of <inertial> to @gsv:auto. SDFormat has @auto since 1.11. libsdformat 12 drops
  // it, but keeps attributes with a namespace prefix.
  void KeepAutomaticInertia(XMLElement& element) {
    const char* text = element.Attribute("auto");
    if (text == nullptr || std::strcmp(element.Name(), "inertial") != 0) return;
    bool is_automatic = false;
    if (element.QueryBoolAttribute("auto", &is_automatic) != tinyxml2::XML_SUCCESS) {
      Warn(element, "@auto of <inertial> must be true or false, not \"" + std::string(text) +
                        "\"; false is used");
    }
    if (is_automatic) element.SetAttribute("gsv:auto", true);
  }

  // Whether the element cannot be used and must be removed.
  bool IsLeftOut(XMLElement& element) {
    std::string reason;
    if (std::strcmp(element.Name(), "joint") == 0) {
      for (const char* end : {"parent", "child"}) {
        if (reason.empty() && IsBlank(element.FirstChildElement(end))) {
          reason = "has no <" + std::string(end) + ">";
        }
      }
    } else if (std::strcmp(element.Name(), "sensor") == 0 && element.Attribute("type") == nullptr) {
      reason = "has no type";
    }
    if (reason.empty()) return false;
    Warn(element, NameOf(element) + " " + reason + "; it is ignored");
    element.Parent()->DeleteChild(&element);
    return true;
  }

  void RepairAttributes(XMLElement& element, const sdf::ElementPtr& description) {
    for (std::size_t i = 0; i < description->GetAttributeCount(); ++i) {
      const sdf::ParamPtr attribute = description->GetAttribute(static_cast<unsigned>(i));
      const std::string& key = attribute->GetKey();
      const std::string otherwise = attribute->GetDefaultAsString();
      const char* written = element.Attribute(key.c_str());
      if (written == nullptr || (attribute->GetRequired() && *written == '\0')) {
        if (attribute->GetRequired()) AddAttribute(element, key, otherwise);
        continue;
      }
      const RepairedText repaired = RepairText(attribute->GetTypeName(), written, otherwise);
      if (repaired.wrong.empty()) continue;
      Warn(element, "@" + key + " of " + NameOf(element) + " holds " + Quoted(written) + ": " +
                        repaired.wrong + "; " + repaired.text + " is used");
      element.SetAttribute(key.c_str(), repaired.text.c_str());
    }
    CheckKind(element);
  }

  void AddAttribute(XMLElement& element, const std::string& key, const std::string& otherwise) {
    std::string value = otherwise;
    if (key == "name") {
      value = FreeName(element);
    } else if (value == kNoDefault || value.empty()) {
      value = std::strcmp(element.Name(), "joint") == 0 ? "fixed" : "none";
    }
    Warn(element, NameOf(element) + " has no @" + key + "; " + Quoted(value) + " is used");
    element.SetAttribute(key.c_str(), value.c_str());
  }

  // Returns a name that no sibling of this kind has.
  static std::string FreeName(const XMLElement& element) {
    std::set<std::string> names;
    const auto* parent = element.Parent()->ToElement();
    for (const auto* each = parent == nullptr ? nullptr : parent->FirstChildElement();
         each != nullptr; each = each->NextSiblingElement()) {
      if (const char* name = each->Attribute("name")) names.insert(name);
    }
    std::string name = std::string("unnamed_") + element.Name();
    const std::string first = name;
    for (int i = 2; names.count(name) != 0; ++i) name = first + "_" + std::to_string(i);
    return name;
  }

  // Checks the type of an element, if it must be one of a list of words.
  void CheckKind(XMLElement& element) {
    static const std::set<std::string> joints = {"revolute", "continuous", "prismatic",
                                                 "gearbox",  "revolute2",  "ball",
                                                 "screw",    "universal",  "fixed"};
    static const std::set<std::string> lights = {"point", "spot", "directional"};
    const char* type = element.Attribute("type");
    if (type == nullptr) return;
    const bool is_joint = std::strcmp(element.Name(), "joint") == 0;
    const bool is_light = std::strcmp(element.Name(), "light") == 0;
    const std::set<std::string>& known = is_joint ? joints : lights;
    if ((!is_joint && !is_light) || known.count(type) != 0) return;
    const char* taken = is_joint ? "fixed" : "point";
    Warn(element,
         NameOf(element) + " is of the unknown type " + Quoted(type) + "; " + taken + " is used");
    element.SetAttribute("type", taken);
  }

  // Whether the element is the direction of a joint's axis.
  static bool IsAxis(const XMLElement& element) {
    const auto* parent = element.Parent()->ToElement();
    return std::strcmp(element.Name(), "xyz") == 0 && parent != nullptr &&
           std::strncmp(parent->Name(), "axis", 4) == 0;
  }

  void RepairOwnText(XMLElement& element, const sdf::ElementPtr& description) {
    const sdf::ParamPtr value = description->GetValue();
    if (value == nullptr || IsBlank(&element)) return;
    const char* format = element.Attribute("rotation_format");
    const bool has_quaternion = format != nullptr && std::strcmp(format, "quat_xyzw") == 0;
    const std::string written = element.GetText();
    RepairedText repaired =
        RepairText(value->GetTypeName(), written, value->GetDefaultAsString(), has_quaternion);
    if (IsAxis(element) && IsZeroVector(written)) {
      repaired = {value->GetDefaultAsString(), "an axis needs a length above 0"};
    }
    if (repaired.wrong.empty()) return;
    Warn(element, Tag(element) + " holds " + Quoted(written) + ": " + repaired.wrong + "; " +
                      repaired.text + " is used");
    element.SetText(repaired.text.c_str());
  }

  const std::filesystem::path& file_;
  base::Problems& problems_;
};

}  // namespace

void RepairValues(XMLElement& element, const std::filesystem::path& file,
                  base::Problems& problems) {
  const sdf::ElementPtr schema = Schema();
  sdf::ElementPtr description =
      std::strcmp(element.Name(), "sdf") == 0 ? schema : DescriptionOf(element.Name(), schema);
  if (std::strcmp(element.Name(), "sensor") == 0) {
    const sdf::ElementPtr link =
        schema->GetElementDescription("model")->GetElementDescription("link");
    description = link->GetElementDescription("sensor");
  }
  if (description != nullptr) ValueRepair(file, problems).Visit(element, description);
}

}  // namespace gsv::formats
