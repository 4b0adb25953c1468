#include "gsv/formats/meshes/collada_repair.h"

#include <cstring>
#include <set>

#include <tinyxml2.h>

#include "gsv/formats/meshes/collada_check.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;
using tinyxml2::XMLNode;

constexpr char kNoImage[] = "no_image";

bool IsElement(const XMLElement& element, const char* name) {
  return std::strcmp(element.Name(), name) == 0;
}

std::string PrintOut(const tinyxml2::XMLDocument& document) {
  tinyxml2::XMLPrinter printer(nullptr, true);
  document.Print(&printer);
  return printer.CStr();
}

class ColladaText {
 public:
  explicit ColladaText(tinyxml2::XMLDocument& document) : document_(document) {}

  ColladaRepair Repair() {
    Visit(*document_.RootElement());
    LeaveOutHarmfulGeometries();
    return std::move(repair_);
  }
  bool is_changed() const { return is_changed_; }

 private:
  void Visit(XMLElement& element) {
    const char* name = element.Attribute("name");
    const char* id = element.Attribute("id");
    if (name != nullptr && id != nullptr &&
        (IsElement(element, "node") || IsElement(element, "geometry"))) {
      repair_.ids_of.emplace(name, id);
    }
    XMLNode* next = nullptr;
    for (XMLNode* child = element.FirstChild(); child != nullptr; child = next) {
      next = child->NextSibling();
      if (child->ToComment() != nullptr) {
        element.DeleteChild(child);
        is_changed_ = true;
      } else if (XMLElement* inner = child->ToElement()) {
        Visit(*inner);
        if (IsElement(*inner, "ph")) {
          CloseHoles(*inner);
        } else if (IsElement(*inner, "image")) {
          NameImage(*inner);
        }
      }
    }
  }

  // Removes the holes of a polygon: <ph><p>outline</p><h>hole</h></ph> becomes <p>outline</p>.
  void CloseHoles(XMLElement& polygon) {
    XMLNode* parent = polygon.Parent();
    if (XMLElement* outline = polygon.FirstChildElement("p")) {
      parent->InsertAfterChild(&polygon, outline);
    }
    parent->DeleteChild(&polygon);
    is_changed_ = true;
    if (!has_closed_holes_) repair_.changes.push_back("holes in polygons are closed");
    has_closed_holes_ = true;
  }

  void NameImage(XMLElement& image) {
    if (image.FirstChildElement("data") != nullptr) return;
    XMLElement* file = image.FirstChildElement("init_from");
    if (file != nullptr && (file->FirstChildElement() != nullptr ||
                            (file->GetText() != nullptr && *file->GetText() != '\0'))) {
      return;
    }
    if (file == nullptr) file = image.InsertNewChildElement("init_from");
    file->SetText(kNoImage);
    is_changed_ = true;
  }

  void LeaveOutHarmfulGeometries() {
    const XMLElement* library = document_.RootElement()->FirstChildElement("library_geometries");
    if (library == nullptr ||
        library->FirstChildElement("geometry") == library->LastChildElement("geometry")) {
      return;
    }
    auto* geometries = const_cast<XMLElement*>(library);
    XMLElement* next = nullptr;
    for (auto* each = geometries->FirstChildElement("geometry"); each != nullptr; each = next) {
      next = each->NextSiblingElement("geometry");
      tinyxml2::XMLPrinter printer(nullptr, true);
      each->Accept(&printer);
      const auto checked = CheckCollada(printer.CStr(), "");
      if (checked) continue;
      const char* id = each->Attribute("id");
      repair_.changes.push_back("the geometry " + std::string(id == nullptr ? "" : id) +
                                " is ignored: " + checked.error().message);
      geometries->DeleteChild(each);
      is_changed_ = true;
    }
  }

  tinyxml2::XMLDocument& document_;
  ColladaRepair repair_;
  bool is_changed_ = false;
  bool has_closed_holes_ = false;
};

}  // namespace

ColladaRepair RepairCollada(std::string& text) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS ||
      document.RootElement() == nullptr) {
    return {};
  }
  ColladaText collada(document);
  ColladaRepair repair = collada.Repair();
  if (collada.is_changed()) text = PrintOut(document);
  return repair;
}

bool SimplifyCollada(std::string& text, int level) {
  static const std::set<std::string> needless = {
      "library_animations",     "library_animation_clips",  "library_cameras",
      "library_lights",         "library_force_fields",     "library_physics_models",
      "library_physics_scenes", "library_physics_materials"};
  static const std::set<std::string> looks = {"library_materials", "library_effects",
                                              "library_images"};
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS ||
      document.RootElement() == nullptr) {
    return false;
  }
  bool is_changed = false;
  XMLElement* next = nullptr;
  for (auto* child = document.RootElement()->FirstChildElement(); child != nullptr; child = next) {
    next = child->NextSiblingElement();
    const bool is_dropped =
        needless.count(child->Name()) != 0 || (level > 1 && looks.count(child->Name()) != 0);
    if (!is_dropped) continue;
    document.RootElement()->DeleteChild(child);
    is_changed = true;
  }
  if (is_changed) text = PrintOut(document);
  return is_changed;
}

}  // namespace gsv::formats
