#include "gsv/formats/sdf/joint_mimic.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/formats/sdf/value_text.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;

constexpr int kMaxModelDepth = 32;

class MimicReader {
 public:
  MimicReader(const std::filesystem::path& file, model::Model& model, base::Problems& problems)
      : file_(file), model_(model), problems_(problems) {}

  void Visit(const XMLElement& model, const std::string& scope, int levels_left) {
    if (levels_left == 0) return;
    for (auto* child = model.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const char* name = child->Attribute("name");
      if (name == nullptr) continue;
      if (std::strcmp(child->Name(), "joint") == 0) {
        Read(*child, scope, name);
      } else if (std::strcmp(child->Name(), "model") == 0) {
        Visit(*child, scope + name + "::", levels_left - 1);
      }
    }
  }

  // Removes the <mimic> of joints that follow each other in a cycle.
  void DropCycles() {
    for (model::Joint& joint : model_.joints) {
      if (!joint.mimic) continue;
      std::size_t followed = 0;
      for (const model::Joint* at = &joint; at->mimic && followed <= model_.joints.size();
           ++followed) {
        at = &model_.joints[static_cast<std::size_t>(at->mimic->leader)];
      }
      if (followed <= model_.joints.size()) continue;
      problems_.push_back({base::Problem::Severity::kWarning,
                           "the joint \"" + joint.name +
                               "\" follows itself by <mimic>; it moves independently instead",
                           file_.string()});
      joint.mimic.reset();
    }
  }

 private:
  void Read(const XMLElement& element, const std::string& scope, const std::string& name) {
    const XMLElement* mimic = element.FirstChildElement("mimic");  // URDF
    const XMLElement* axis = element.FirstChildElement("axis");
    if (mimic == nullptr && axis != nullptr) mimic = axis->FirstChildElement("mimic");
    if (mimic == nullptr) return;
    const char* leader_name = mimic->Attribute("joint");
    const int follower = model::FindJoint(model_.joints, scope + name);
    const int leader =
        leader_name == nullptr ? -1 : model::FindJoint(model_.joints, scope + leader_name);
    if (follower < 0 || leader < 0 || leader == follower) {
      std::string why;
      if (leader_name == nullptr) {
        why = "it names no joint";
      } else if (leader < 0) {
        why = "it names " + Quoted(leader_name) + ", which is not a movable joint";
      } else {
        why = leader == follower ? "a joint cannot follow itself" : "the joint cannot move";
      }
      problems_.push_back({base::Problem::Severity::kWarning,
                           "the <mimic> of the joint \"" + scope + name + "\" is ignored: " + why,
                           PlaceOf(file_, *mimic)});
      return;
    }
    model_.joints[static_cast<std::size_t>(follower)].mimic =
        model::Mimic{leader, Number(*mimic, "multiplier", 1), Number(*mimic, "offset", 0),
                     Number(*mimic, "reference", 0)};
  }

  // Returns a value, which is an attribute in URDF and an element in SDFormat.
  double Number(const XMLElement& mimic, const char* name, double otherwise) {
    const char* text = mimic.Attribute(name);
    if (const auto* child = mimic.FirstChildElement(name)) text = child->GetText();
    if (text == nullptr) return otherwise;
    const LeadingNumber number = LeadingNumberOf(text);
    if (number.is_number && std::isfinite(number.value)) return number.value;
    problems_.push_back({base::Problem::Severity::kWarning,
                         "<mimic> has " + Quoted(text) + " for its " + name +
                             ", which is not a number; the default is used",
                         PlaceOf(file_, mimic)});
    return otherwise;
  }

  const std::filesystem::path& file_;
  model::Model& model_;
  base::Problems& problems_;
};

}  // namespace

std::shared_ptr<const model::Model> WithMimics(const XMLElement& element,
                                               const std::filesystem::path& file,
                                               std::shared_ptr<const model::Model> read,
                                               base::Problems& problems) {
  if (read == nullptr || read->joints.empty() || read->script != nullptr) return read;
  auto following = std::make_shared<model::Model>(*read);
  MimicReader reader(file, *following, problems);
  reader.Visit(element, "", kMaxModelDepth);
  reader.DropCycles();
  const bool any = std::any_of(following->joints.begin(), following->joints.end(),
                               [](const model::Joint& joint) { return joint.mimic.has_value(); });
  if (any) return following;
  return read;
}

}  // namespace gsv::formats
