#include "gsv/formats/sdf/urdf_repair.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/formats/sdf/urdf_part_repair.h"
#include "gsv/formats/sdf/value_text.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;

constexpr double kDefaultMass = 0.1;  // kg
constexpr double kMinMass = 1e-6;     // kg; libsdformat ignores a smaller mass
constexpr std::size_t kMaxNamed = 8;  // maximum number of links named in one message
constexpr char kWorld[] = "world";    // libsdformat treats a link with this name as the world

struct UrdfJoint {
  XMLElement* element;
  std::string name, parent, child;

  bool Is(const char* type) const {
    const char* own = element->Attribute("type");
    return own != nullptr && std::strcmp(own, type) == 0;
  }
};

std::string LinkOf(const XMLElement& joint, const char* end) {
  const XMLElement* element = joint.FirstChildElement(end);
  const char* name = element == nullptr ? nullptr : element->Attribute("link");
  return name == nullptr ? "" : name;
}

class UrdfRepair {
 public:
  UrdfRepair(XMLElement& robot, const std::filesystem::path& file, base::Problems& problems)
      : robot_(robot), file_(file), problems_(problems) {}

  void Repair() {
    robot_.DeleteAttribute("version");
    if (robot_.Attribute("name") == nullptr || *robot_.Attribute("name") == '\0') {
      Warn(robot_, "<robot> has no name; the name of its file is used");
      robot_.SetAttribute("name", file_.stem().string().c_str());
    }
    RepairUrdfParts(robot_, file_, problems_);
    TakeLinks();
    TakeJoints();
    ReportUnknownReferences();
    KeepLargestTree();
    FreeFloatingRoots();
    GiveMass();
  }

 private:
  void Warn(const XMLElement& element, const std::string& message) {
    problems_.push_back({base::Problem::Severity::kWarning, message, PlaceOf(file_, element)});
  }

  void LeaveOut(XMLElement& element, const std::string& what, const std::string& reason) {
    Warn(element, what + " is ignored: " + reason);
    robot_.DeleteChild(&element);
  }

  void TakeLinks() {
    XMLElement* next = nullptr;
    for (auto* link = robot_.FirstChildElement("link"); link != nullptr; link = next) {
      next = link->NextSiblingElement("link");
      const char* name = link->Attribute("name");
      if (name == nullptr || *name == '\0') {
        LeaveOut(*link, "a link", "it has no name");
      } else if (!links_.emplace(name, link).second) {
        LeaveOut(*link, "the link \"" + std::string(name) + "\"",
                 "there is one of that name already");
      }
    }
  }

  void TakeJoints() {
    static const std::set<std::string> types = {"revolute", "continuous", "prismatic",
                                                "fixed",    "floating",   "planar"};
    std::set<std::string> names;
    XMLElement* next = nullptr;
    for (auto* element = robot_.FirstChildElement("joint"); element != nullptr; element = next) {
      next = element->NextSiblingElement("joint");
      const char* name = element->Attribute("name");
      UrdfJoint joint{element, name == nullptr ? "" : name, LinkOf(*element, "parent"),
                      LinkOf(*element, "child")};
      const std::string what = "the joint \"" + joint.name + "\"";
      if (const std::string wrong = WrongWith(joint); !wrong.empty()) {
        LeaveOut(*element, what, wrong);
        continue;
      }
      if (joint.name.empty() || !names.insert(joint.name).second) {
        const std::string old = std::exchange(joint.name, "joint_of_" + joint.child);
        Warn(*element,
             (old.empty() ? "a joint has no name" : "there is a second joint \"" + old + "\"") +
                 "; it is named " + joint.name);
        element->SetAttribute("name", joint.name.c_str());
        names.insert(joint.name);
      }
      const char* type = element->Attribute("type");
      if (type == nullptr || types.count(type) == 0) {
        Warn(*element, what + " has " +
                           (type == nullptr ? "no type" : "the unknown type " + Quoted(type)) +
                           "; it is read as a fixed joint");
        element->SetAttribute("type", "fixed");
      }
      above_[joint.child] = joints_.size();
      joints_.push_back(std::move(joint));
    }
  }

  // Warns of <gazebo> elements for links and joints that do not exist, because libsdformat drops
  // these elements silently.
  void ReportUnknownReferences() {
    for (const auto* gazebo = robot_.FirstChildElement("gazebo"); gazebo != nullptr;
         gazebo = gazebo->NextSiblingElement("gazebo")) {
      const char* reference = gazebo->Attribute("reference");
      if (reference == nullptr || *reference == '\0' || links_.count(reference) != 0) continue;
      bool is_joint = false;
      for (const auto* joint = robot_.FirstChildElement("joint"); joint != nullptr && !is_joint;
           joint = joint->NextSiblingElement("joint")) {
        const char* name = joint->Attribute("name");
        is_joint = name != nullptr && std::strcmp(name, reference) == 0;
      }
      if (is_joint) continue;
      Warn(*gazebo, "<gazebo> is ignored: its @reference names " + Quoted(reference) +
                        ", and the robot has no such link or joint");
    }
  }

  std::string WrongWith(const UrdfJoint& joint) const {
    for (const auto& [end, name] :
         {std::pair{"parent", joint.parent}, std::pair{"child", joint.child}}) {
      if (name.empty()) return "it has no <" + std::string(end) + "> with @link";
      if (links_.count(name) == 0) {
        return "its " + std::string(end) + " link \"" + name + "\" does not exist";
      }
    }
    if (above_.count(joint.child) != 0 || RootOf(joint.parent) == joint.child) {
      return "it closes a loop, which is not supported";
    }
    return "";
  }

  std::string RootOf(std::string link) const {
    for (auto it = above_.find(link); it != above_.end(); it = above_.find(link)) {
      link = joints_[it->second].parent;
    }
    return link;
  }

  // Keeps only the largest tree of links that are connected by joints, because urdfdom requires a
  // single tree.
  void KeepLargestTree() {
    std::map<std::string, std::vector<std::string>> trees;  // links by the root of their tree
    for (const auto& [name, link] : links_) trees[RootOf(name)].push_back(name);
    if (trees.size() < 2) return;
    // Of trees with equal size, the first by line is kept.
    const auto rank = [&](const auto& tree) {
      return std::make_pair(tree.second.size(), -links_.at(tree.first)->GetLineNum());
    };
    const auto largest =
        std::max_element(trees.begin(), trees.end(),
                         [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    for (const auto& [root, links] : trees) {
      if (root == largest->first) continue;
      Warn(*links_.at(root), "no joint connects the link \"" + root +
                                 "\" to the robot; it is ignored" +
                                 (links.size() > 1 ? " with all below it" : ""));
      for (const std::string& name : links) Remove(name);
    }
  }

  // Removes the link and the joint above it.
  void Remove(const std::string& link) {
    const auto joint = std::find_if(joints_.begin(), joints_.end(),
                                    [&](const UrdfJoint& each) { return each.child == link; });
    if (joint != joints_.end()) RemoveJoint(*joint);
    robot_.DeleteChild(links_.at(link));
    links_.erase(link);
  }

  void RemoveJoint(const UrdfJoint& joint) {
    robot_.DeleteChild(joint.element);
    joints_.erase(std::find_if(joints_.begin(), joints_.end(), [&](const UrdfJoint& each) {
      return each.element == joint.element;
    }));
    above_.clear();
    for (std::size_t i = 0; i < joints_.size(); ++i) above_[joints_[i].child] = i;
  }

  bool IsEmptyLink(const std::string& name) const {
    const XMLElement* link = links_.at(name);
    for (const char* part : {"inertial", "visual", "collision"}) {
      if (link->FirstChildElement(part) != nullptr) return false;
    }
    return true;
  }

  // Removes a root link that only represents the world, so that the robot can move freely.
  void FreeFloatingRoots() {
    for (bool is_changed = true; is_changed;) {
      is_changed = false;
      for (const UrdfJoint& joint : joints_) {
        if (!joint.Is("floating") && !joint.Is("planar")) continue;
        const auto children =
            std::count_if(joints_.begin(), joints_.end(),
                          [&](const UrdfJoint& each) { return each.parent == joint.parent; });
        if (above_.count(joint.parent) != 0 || children != 1 || !IsEmptyLink(joint.parent))
          continue;
        const std::string root = joint.parent;
        RemoveJoint(UrdfJoint(joint));
        Remove(root);
        is_changed = true;
        break;
      }
    }
    for (const UrdfJoint& joint : joints_) {
      if (!joint.Is("floating") && !joint.Is("planar")) continue;
      Warn(*joint.element, std::string(joint.element->Attribute("type")) +
                               " joints between links are not supported; \"" + joint.name +
                               "\" is fixed");
      joint.element->SetAttribute("type", "fixed");
    }
  }

  // Whether libsdformat merges the two links that the joint connects.
  bool IsLumped(const UrdfJoint& joint) const {
    if (!joint.Is("fixed") || joint.parent == kWorld) return false;
    for (const auto* gazebo = robot_.FirstChildElement("gazebo"); gazebo != nullptr;
         gazebo = gazebo->NextSiblingElement("gazebo")) {
      const char* reference = gazebo->Attribute("reference");
      if (reference == nullptr || joint.name != reference) continue;
      for (const char* option : {"preserveFixedJoint", "disableFixedJointLumping"}) {
        const XMLElement* kept = gazebo->FirstChildElement(option);
        const char* text = kept == nullptr ? nullptr : kept->GetText();
        if (text != nullptr &&
            (std::strstr(text, "true") != nullptr || std::strstr(text, "1") != nullptr)) {
          return false;
        }
      }
    }
    return true;
  }

  // Gives a mass to links without mass. libsdformat drops a link without mass, with its joint and
  // all links below it. A group of links that are fixed together needs only one link with mass.
  void GiveMass() {
    // whether each group of links that are fixed together has mass, by the top link of the group
    std::map<std::string, bool> has_mass;
    std::vector<std::string> order;
    for (auto* link = robot_.FirstChildElement("link"); link != nullptr;
         link = link->NextSiblingElement("link")) {
      order.push_back(link->Attribute("name"));
    }
    for (const std::string& name : order) {
      bool& is_heavy = has_mass[TopOf(name)];
      is_heavy = KeepMass(*links_.at(name)) || is_heavy;
    }
    std::vector<std::string> given;
    for (const std::string& name : order) {
      if (TopOf(name) != name || has_mass.at(name) || name == kWorld) continue;
      AddInertial(*links_.at(name), kDefaultMass);
      given.push_back(name);
    }
    if (given.empty()) return;
    std::string list;
    for (std::size_t i = 0; i < std::min(given.size(), kMaxNamed); ++i) {
      list += (i == 0 ? "" : ", ") + given[i];
    }
    if (given.size() > kMaxNamed)
      list += " and " + std::to_string(given.size() - kMaxNamed) + " more";
    Warn(*links_.at(given.front()),
         (given.size() == 1 ? "a link has" : std::to_string(given.size()) + " links have") +
             std::string(" no mass (no <inertial>, or a <mass> that is not above zero): ") + list +
             "; 0.1 kg is used" + (given.size() == 1 ? "" : " for each"));
  }

  std::string TopOf(std::string link) const {
    for (auto it = above_.find(link); it != above_.end() && IsLumped(joints_[it->second]);
         it = above_.find(link)) {
      link = joints_[it->second].parent;
    }
    return link;
  }

  // Whether the link has a positive mass. Removes an <inertial> without a positive mass.
  static bool KeepMass(XMLElement& link) {
    XMLElement* inertial = link.FirstChildElement("inertial");
    if (inertial == nullptr) return false;
    const XMLElement* mass = inertial->FirstChildElement("mass");
    const char* text = mass == nullptr ? nullptr : mass->Attribute("value");
    const double kilograms = text == nullptr ? 0 : LeadingNumberOf(text).value;
    if (kilograms > kMinMass && std::isfinite(kilograms)) return true;
    link.DeleteChild(inertial);
    return false;
  }

  XMLElement& robot_;
  const std::filesystem::path& file_;
  base::Problems& problems_;
  std::map<std::string, XMLElement*> links_;
  std::vector<UrdfJoint> joints_;
  std::map<std::string, std::size_t> above_;  // index of the joint above a link, by its name
};

}  // namespace

void RepairUrdf(XMLElement& robot, const std::filesystem::path& file, base::Problems& problems) {
  UrdfRepair(robot, file, problems).Repair();
}

}  // namespace gsv::formats
