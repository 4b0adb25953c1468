#include "gsv/formats/support/element_audit.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/formats/support/element_path.h"
#include "gsv/formats/support/plugin_audit.h"
#include "gsv/formats/support/same_text.h"
#include "gsv/formats/support/spelling.h"
#include "gsv/formats/support/support_table.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLAttribute;
using tinyxml2::XMLElement;

constexpr std::string_view kXmlSpace = " \t\r\n";

bool IsNamespaced(std::string_view name) { return name.find(':') != std::string_view::npos; }

std::string Tag(std::string_view name) { return "<" + std::string(name) + ">"; }

std::string Spaced(const std::string& sentence) { return sentence.empty() ? "" : " " + sentence; }

// Whether the element is a sensor whose type SDFormat does not define: a type of GSV, or a type
// that a plug-in may define.
bool IsSensorOfOurs(const XMLElement& element) {
  static constexpr std::string_view kTypes[] = {"air_flow",
                                                "air_pressure",
                                                "air_speed",
                                                "altimeter",
                                                "boundingbox",
                                                "boundingbox_camera",
                                                "camera",
                                                "contact",
                                                "depth",
                                                "depth_camera",
                                                "force_torque",
                                                "gps",
                                                "gpu_lidar",
                                                "gpu_ray",
                                                "imu",
                                                "lidar",
                                                "logical_camera",
                                                "magnetometer",
                                                "multicamera",
                                                "navsat",
                                                "ray",
                                                "rfid",
                                                "rfidtag",
                                                "rgbd",
                                                "rgbd_camera",
                                                "segmentation",
                                                "segmentation_camera",
                                                "sonar",
                                                "thermal",
                                                "thermal_camera",
                                                "wideanglecamera",
                                                "wireless_receiver",
                                                "wireless_transmitter"};
  const char* type = element.Attribute("type");
  return std::string_view(element.Name()) == "sensor" && type != nullptr &&
         std::find(std::begin(kTypes), std::end(kTypes), type) == std::end(kTypes);
}

class ElementAudit {
 public:
  ElementAudit(const AuditedFile& file, base::Problems& problems)
      : file_(file), problems_(problems) {}

  void Run() {
    const SupportTable& table = SupportTable::Get();
    if (file_.minor_version == 0) {
      Visit(*file_.root, table.urdf());
    } else {
      VisitRoot(table.sdf());
    }
    if (unreported_ > 0) {
      problems_.push_back(
          {base::Problem::Severity::kWarning,
           std::to_string(unreported_) + " more elements are unknown or not supported in this file",
           file_.path.string()});
    }
  }

 private:
  void Report(std::string message, const XMLElement& element) {
    if (reported_ == kMaxFindings) {
      ++unreported_;
      return;
    }
    ++reported_;
    const std::string path = PathOf(element);
    problems_.push_back({base::Problem::Severity::kWarning, std::move(message),
                         PlaceOf(file_.path, element) + (path.empty() ? "" : ": " + path)});
  }

  // Visits <sdf> or <robot>. Of its children, visits only the one that the reader uses: the first
  // world, else the first model, else the first light.
  void VisitRoot(const ElementSupport& root) {
    const XMLElement* taken = nullptr;
    for (const char* kind : {"world", "model", "light"}) {
      if (taken == nullptr) taken = file_.root->FirstChildElement(kind);
    }
    VisitAttributes(*file_.root, root);
    ReportTextBesideElements(*file_.root);
    for (auto* child = file_.root->FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      const ElementSupport* known = root.Child(name);
      if (IsNamespaced(name)) continue;
      if (known == nullptr) {
        ReportUnknown(*child, *file_.root, root);
      } else if (child == taken) {
        Visit(*child, *known);
      } else if (name != "world" && taken != nullptr) {  // world_reader.cc reports a second world
        Report(Tag(name) + " beside a " + Tag(taken->Name()) + " is ignored" +
                   (std::string_view(taken->Name()) == "world" ? ". It belongs in <world>."
                                                               : "; a file may contain one model"),
               *child);
      }
    }
  }

  void Visit(const XMLElement& element, const ElementSupport& support) {
    above_.push_back({&element, &support});
    VisitAttributes(element, support);
    ReportTextBesideElements(element);
    const XMLElement* shape = nullptr;
    for (auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      VisitChild(*child, element, support);
      if (support.definition == nullptr || support.name != "geometry") continue;
      if (shape == nullptr) {
        shape = child;
      } else if (std::string_view(shape->Name()) != child->Name() && !IsNamespaced(child->Name())) {
        Report("a second shape in <geometry>, " + Tag(child->Name()) +
                   ", is ignored; a geometry may contain one",
               *child);
      }
    }
    above_.pop_back();
  }

  // Reports text beside elements: an element has either a value or elements. Such a text is mostly
  // a remnant of a comment. CDATA sections are ignored, because Gazebo's own worlds use them as
  // comments.
  void ReportTextBesideElements(const XMLElement& element) {
    if (element.FirstChildElement() == nullptr) return;
    for (auto* child = element.FirstChild(); child != nullptr; child = child->NextSibling()) {
      const tinyxml2::XMLText* text = child->ToText();
      if (text == nullptr || text->CData()) continue;
      const std::string_view value = text->Value();
      const std::size_t first = value.find_first_not_of(kXmlSpace);
      if (first == std::string_view::npos) continue;
      constexpr std::size_t kMaxQuoted = 40;
      const std::size_t length = value.find_last_not_of(kXmlSpace) - first + 1;
      std::string quoted(value.substr(first, std::min(length, kMaxQuoted)));
      std::replace(quoted.begin(), quoted.end(), '\n', ' ');
      Report("the text \"" + quoted + (length > kMaxQuoted ? "…" : "") + "\" in " +
                 Tag(element.Name()) + " is ignored",
             element);
      return;
    }
  }

  void VisitAttributes(const XMLElement& element, const ElementSupport& support) {
    for (const XMLAttribute* attribute = element.FirstAttribute(); attribute != nullptr;
         attribute = attribute->Next()) {
      const std::string_view name = attribute->Name();
      if (IsNamespaced(name) || name == "xmlns") continue;
      const ElementSupport* known = support.Attribute(name);
      if (known == nullptr) {
        Report(Tag(element.Name()) + " has no attribute \"" + std::string(name) +
                   "\"; it is ignored." + Spaced(AdviceForAttribute(name, support)),
               element);
      } else if (known->until != 0 && file_.minor_version > known->until) {
        if (SaysDefault(attribute->Value(), *known)) continue;
        Report("the attribute \"" + std::string(name) + "\" of " + Tag(element.Name()) +
                   " ended with SDFormat 1." + std::to_string(known->until) +
                   "; it is ignored in a file of 1." + std::to_string(file_.minor_version),
               element);
      } else if (known->support == Support::kNone && !SaysDefault(attribute->Value(), *known)) {
        Report("the attribute \"" + std::string(name) + "\" of " + Tag(element.Name()) +
                   " is not supported" + NoteOf(*known),
               element);
      }
    }
  }

  void VisitChild(const XMLElement& child, const XMLElement& parent,
                  const ElementSupport& support) {
    const std::string_view name = child.Name();
    if (IsNamespaced(name)) {
      VisitOurs(child);
      return;
    }
    if (name == "plugin" && support.Child(name) != nullptr) {
      for (const std::string& sentence : AboutPlugin(child)) Report(sentence, child);
      return;
    }
    const ElementSupport* known = support.Child(name);
    if (known == nullptr) {
      if (!IsSensorOfOurs(parent)) {
        ReportUnknown(child, parent, support);
      } else if (IsOurSensorType(parent.Attribute("type")) &&
                 !AboutOurElement("gsv:" + std::string(name), false).empty()) {
        Report(Tag(name) + " is not a parameter of a sensor of the type " +
                   parent.Attribute("type") + "; it is ignored",
               child);
      }
    } else if (known->until != 0 && file_.minor_version > known->until) {
      Report(Tag(name) + " in " + Tag(parent.Name()) + " ended with SDFormat 1." +
                 std::to_string(known->until) + "; it is ignored in a file of 1." +
                 std::to_string(file_.minor_version),
             child);
    } else if (!known->is_repeatable && child.PreviousSiblingElement(child.Name()) != nullptr) {
      Report("a second " + Tag(name) + " in " + Tag(parent.Name()) +
                 " is ignored; the first one is used",
             child);
    } else {
      VisitKnown(child, *known);
    }
  }

  // Visits GSV's own elements, and the elements in them. Elements of other namespaces are ignored,
  // because they are for other programs.
  void VisitOurs(const XMLElement& element) {
    const auto sentence = AboutOurElement(element.Name(), IsInSensorOfPlugin());
    if (!sentence.empty()) {
      Report(sentence, element);
      return;
    }
    if (std::string_view(element.Name()) == "gsv:slip" && element.Parent() != nullptr) {
      const std::string_view parent = element.Parent()->Value();
      if (parent != "model" && parent != "surface") {
        Report("<gsv:slip> in " + Tag(parent) +
                   " is ignored. It belongs in <model> or in the <surface> of a collision.",
               element);
        return;
      }
    }
    for (auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      VisitOurs(*child);
    }
  }

  bool IsInSensorOfPlugin() const {
    return std::any_of(above_.begin(), above_.end(), [](const Above& each) {
      return IsSensorOfOurs(*each.element) && !IsOurSensorType(each.element->Attribute("type"));
    });
  }

  void VisitKnown(const XMLElement& element, const ElementSupport& support) {
    if (support.support == Support::kNoEffect) return;
    // An unsupported element with a name is a thing of its own, such as a <projector>. So it is
    // reported even if it has only default values.
    const bool is_thing = support.support == Support::kNone && element.Attribute("name") != nullptr;
    if (support.support != Support::kFull && (is_thing || !HasOnlyDefaults(element, support))) {
      Report(
          Tag(element.Name()) +
              (support.support == Support::kNone ? " is not supported" : " is supported in part") +
              NoteOf(support),
          element);
    }
    if (support.support != Support::kNone) Visit(element, support);
  }

  void ReportUnknown(const XMLElement& element, const XMLElement& parent,
                     const ElementSupport& support) {
    const std::string_view name = element.Name();
    std::string advice = AdviceForElement(name, support, parent.Name());
    if (advice.empty()) advice = AdviceFromAbove(name);
    Report(Tag(name) + " is not an element of " + Tag(parent.Name()) + "; it is ignored." +
               Spaced(advice),
           element);
  }

  std::string AdviceFromAbove(std::string_view name) const {
    for (auto each = above_.rbegin(); each != above_.rend(); ++each) {
      if (each->support->Child(name) != nullptr) {
        return "It belongs in " + Tag(each->element->Name()) + ".";
      }
    }
    return {};
  }

  static std::string NoteOf(const ElementSupport& support) {
    return support.note.empty() ? std::string() : ": " + std::string(support.note);
  }

  static bool SaysDefault(const char* text, const ElementSupport& support) {
    return support.otherwise && HasSameMeaning(text == nullptr ? "" : text, *support.otherwise);
  }

  // Whether the element and its content have only default values.
  static bool HasOnlyDefaults(const XMLElement& element, const ElementSupport& support) {
    for (const XMLAttribute* attribute = element.FirstAttribute(); attribute != nullptr;
         attribute = attribute->Next()) {
      const ElementSupport* known = support.Attribute(attribute->Name());
      if (known == nullptr) return false;
      if (known->support == Support::kNone && !SaysDefault(attribute->Value(), *known))
        return false;
    }
    const XMLElement* child = element.FirstChildElement();
    if (child == nullptr) {
      const char* text = element.GetText();
      return text == nullptr || SaysDefault(text, support);
    }
    for (; child != nullptr; child = child->NextSiblingElement()) {
      const ElementSupport* known = support.Child(child->Name());
      if (known == nullptr || !HasOnlyDefaults(*child, *known)) return false;
    }
    return true;
  }

  struct Above {
    const XMLElement* element;
    const ElementSupport* support;
  };

  const AuditedFile& file_;
  base::Problems& problems_;
  std::vector<Above> above_;
  int reported_ = 0, unreported_ = 0;
};

}  // namespace

void AuditElements(const AuditedFile& file, base::Problems& problems) {
  ElementAudit(file, problems).Run();
}

}  // namespace gsv::formats
