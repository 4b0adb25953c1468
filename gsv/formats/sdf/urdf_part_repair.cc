#include "gsv/formats/sdf/urdf_part_repair.h"

#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/formats/sdf/value_repair.h"
#include "gsv/formats/sdf/value_text.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;

constexpr double kBallRadius = 0.05;     // m
constexpr char kNoUrdfLimit[] = "1e16";  // the value that SDFormat writes for "no limit"

// An attribute whose value urdfdom checks, and the value that replaces an invalid one.
struct Attribute {
  const char* element;
  const char* name;
  const char* type;       // see value_text.h
  const char* otherwise;  // the replacement; null if the element requires the attribute
};

constexpr Attribute kAttributes[] = {
    {"origin", "xyz", "vector3", "0 0 0"},
    {"origin", "rpy", "vector3", "0 0 0"},
    {"axis", "xyz", "vector3", "1 0 0"},
    {"box", "size", "vector3", nullptr},
    {"sphere", "radius", "double", nullptr},
    {"cylinder", "radius", "double", nullptr},
    {"cylinder", "length", "double", nullptr},
    {"mesh", "scale", "vector3", "1 1 1"},
    {"color", "rgba", "color", "0.7 0.7 0.7 1"},
    {"mass", "value", "double", nullptr},
    {"inertia", "ixx", "double", nullptr},
    {"inertia", "iyy", "double", nullptr},
    {"inertia", "izz", "double", nullptr},
    {"inertia", "ixy", "double", "0"},
    {"inertia", "ixz", "double", "0"},
    {"inertia", "iyz", "double", "0"},
    {"limit", "lower", "double", "-1e16"},
    {"limit", "upper", "double", kNoUrdfLimit},
    {"limit", "effort", "double", kNoUrdfLimit},
    {"limit", "velocity", "double", kNoUrdfLimit},
    {"dynamics", "damping", "double", "0"},
    {"dynamics", "friction", "double", "0"},
    {"mimic", "multiplier", "double", "1"},
    {"mimic", "offset", "double", "0"},
    {"safety_controller", "soft_lower_limit", "double", "0"},
    {"safety_controller", "soft_upper_limit", "double", "0"},
    {"safety_controller", "k_position", "double", "0"},
    {"safety_controller", "k_velocity", "double", "0"},
    {"calibration", "rising", "double", "0"},
    {"calibration", "falling", "double", "0"},
};

// Elements of <gazebo> that libsdformat reads as numbers.
constexpr const char* kGazeboNumbers[] = {"mu1",
                                          "mu2",
                                          "kp",
                                          "kd",
                                          "maxVel",
                                          "minDepth",
                                          "maxContacts",
                                          "cfm",
                                          "erp",
                                          "stopErp",
                                          "stopCfm",
                                          "fudgeFactor",
                                          "dampingFactor",
                                          "laserRetro",
                                          "fudge_factor",
                                          "stop_cfm",
                                          "stop_erp",
                                          "implicitSpringDamper",
                                          "springStiffness",
                                          "springReference"};

bool Is(const XMLElement& element, const char* name) {
  return std::strcmp(element.Name(), name) == 0;
}

constexpr const char* kInertiaKeys[] = {"ixx", "iyy", "izz", "ixy", "ixz", "iyz"};

double BallMoment(double mass) { return 0.4 * std::abs(mass) * kBallRadius * kBallRadius; }

void WriteBall(XMLElement& inertia, double mass) {
  for (const char* key : kInertiaKeys) {
    inertia.SetAttribute(key, key[1] == key[2] ? BallMoment(mass) : 0.0);
  }
}

std::string NameOfPart(const XMLElement& element) {
  const char* name = element.Attribute("name");
  return "<" + std::string(element.Name()) + ">" +
         (name == nullptr ? "" : " \"" + std::string(name) + "\"");
}

class UrdfPartRepair {
 public:
  UrdfPartRepair(const std::filesystem::path& file, base::Problems& problems)
      : file_(file), problems_(problems) {}

  void Repair(XMLElement& robot) {
    CollectMaterials(robot);
    XMLElement* next = nullptr;
    for (auto* child = robot.FirstChildElement(); child != nullptr; child = next) {
      next = child->NextSiblingElement();
      if (Is(*child, "link")) {
        RepairNumbers(*child);
        RepairLink(*child);
      } else if (Is(*child, "joint")) {
        RepairNumbers(*child);
        RepairJoint(*child);
      } else if (Is(*child, "gazebo")) {
        RepairExtension(*child);
      }
    }
  }

 private:
  void Warn(const XMLElement& element, const std::string& message) {
    problems_.push_back({base::Problem::Severity::kWarning, message, PlaceOf(file_, element)});
  }

  void LeaveOut(XMLElement& element, const std::string& reason) {
    Warn(element, NameOfPart(element) + " is ignored: " + reason);
    element.Parent()->DeleteChild(&element);
  }

  // Repairs malformed numbers. If a required number cannot be repaired, leaves it unchanged, and a
  // later step handles it.
  void RepairNumbers(XMLElement& element) {
    for (const Attribute& known : kAttributes) {
      if (!Is(element, known.element)) continue;
      const char* written = element.Attribute(known.name);
      if (written == nullptr) continue;
      const std::string otherwise = known.otherwise == nullptr ? "" : known.otherwise;
      RepairedText repaired = AsPlainNumbers(RepairText(known.type, written, otherwise), otherwise);
      if (WordsOf(written).empty()) repaired = {otherwise, "it is empty"};
      if (Is(element, "color") && WordsOf(repaired.text).size() == 3) {
        repaired.text += " 1";
        if (repaired.wrong.empty()) repaired.wrong = "4 numbers are expected";
      }
      if (repaired.text.empty()) continue;
      if (!repaired.wrong.empty()) {
        Warn(element, "@" + std::string(known.name) + " of <" + element.Name() + "> holds " +
                          Quoted(written) + ": " + repaired.wrong + "; " + repaired.text +
                          " is used");
      }
      element.SetAttribute(known.name, repaired.text.c_str());
    }
    for (auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      RepairNumbers(*child);
    }
  }

  static bool HasNumber(const XMLElement& element, const char* name) {
    const char* text = element.Attribute(name);
    return text != nullptr && LeadingNumberOf(text).is_number &&
           std::isfinite(LeadingNumberOf(text).value);
  }

  void RepairLink(XMLElement& link) {
    XMLElement* next = nullptr;
    for (auto* child = link.FirstChildElement(); child != nullptr; child = next) {
      next = child->NextSiblingElement();
      if (Is(*child, "inertial")) {
        RepairInertial(*child);
      } else if (Is(*child, "visual") || Is(*child, "collision")) {
        const std::string wrong = WrongWithShape(child->FirstChildElement("geometry"));
        if (!wrong.empty()) {
          LeaveOut(*child, wrong);
        } else if (XMLElement* material = child->FirstChildElement("material")) {
          RepairMaterial(*material);
        }
      }
    }
  }

  static std::string WrongWithShape(const XMLElement* geometry) {
    const XMLElement* shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
    if (shape == nullptr) return "it has no <geometry> with a shape";
    if (Is(*shape, "mesh")) {
      const char* file = shape->Attribute("filename");
      return file == nullptr || *file == '\0' ? "its <mesh> has no @filename" : "";
    }
    if (Is(*shape, "box")) {
      const char* size = shape->Attribute("size");
      const bool is_size = size != nullptr && WordsOf(size).size() >= 3 &&
                           RepairText("vector3", size, "").text == size;
      return is_size ? "" : "its <box> has no @size of three numbers";
    }
    if (Is(*shape, "sphere"))
      return HasNumber(*shape, "radius") ? "" : "its <sphere> has no @radius";
    if (Is(*shape, "cylinder")) {
      return HasNumber(*shape, "radius") && HasNumber(*shape, "length")
                 ? ""
                 : "its <cylinder> has no @radius or no @length";
    }
    return "<" + std::string(shape->Name()) + "> is not a shape of URDF";
  }

  void RepairInertial(XMLElement& inertial) {
    const XMLElement* mass = inertial.FirstChildElement("mass");
    if (mass == nullptr || !HasNumber(*mass, "value")) {
      LeaveOut(inertial, "it has no mass");
      return;
    }
    XMLElement* inertia = inertial.FirstChildElement("inertia");
    const double kilograms = LeadingNumberOf(mass->Attribute("value")).value;
    if (inertia == nullptr || inertia->FirstAttribute() == nullptr) {
      Warn(inertia == nullptr ? inertial : *inertia,
           inertia == nullptr ? "<inertial> has no <inertia>; the inertia of a ball is used"
                              : "<inertia> has no attributes; the inertia of a ball is used");
      if (inertia == nullptr) inertia = inertial.InsertNewChildElement("inertia");
      WriteBall(*inertia, kilograms);
      return;
    }
    const double moment = BallMoment(kilograms);
    for (const char* key : kInertiaKeys) {
      if (HasNumber(*inertia, key)) continue;
      const bool is_moment = key[1] == key[2];
      if (inertia->Attribute(key) != nullptr || is_moment) {
        Warn(*inertia, "<inertia> has no @" + std::string(key) + "; " +
                           (is_moment ? "the inertia of a ball" : "0") + " is used");
      }
      inertia->SetAttribute(key, is_moment ? moment : 0.0);
    }
  }

  void CollectMaterials(XMLElement& robot) {
    XMLElement* next = nullptr;
    for (auto* material = robot.FirstChildElement("material"); material != nullptr;
         material = next) {
      next = material->NextSiblingElement("material");
      RepairNumbers(*material);
      DropEmptyColour(*material);
      const char* name = material->Attribute("name");
      if (name == nullptr || !HasLook(*material)) {
        if (name == nullptr)
          LeaveOut(*material, "it has no name");
        else
          robot.DeleteChild(material);  // the material is empty; the elements that use it are
                                        // reported
      } else if (!materials_.insert(name).second) {
        LeaveOut(*material, "there is one of that name already");
      }
    }
    // Materials that a visual defines are available to all visuals, so collect them too.
    for (auto* link = robot.FirstChildElement("link"); link != nullptr;
         link = link->NextSiblingElement("link")) {
      for (auto* visual = link->FirstChildElement("visual"); visual != nullptr;
           visual = visual->NextSiblingElement("visual")) {
        const XMLElement* material = visual->FirstChildElement("material");
        const char* name = material == nullptr ? nullptr : material->Attribute("name");
        if (name != nullptr && HasLook(*material)) materials_.insert(name);
      }
    }
  }

  static bool HasLook(const XMLElement& material) {
    const XMLElement* texture = material.FirstChildElement("texture");
    const XMLElement* colour = material.FirstChildElement("color");
    return (texture != nullptr && texture->Attribute("filename") != nullptr) ||
           (colour != nullptr && colour->Attribute("rgba") != nullptr);
  }

  static void DropEmptyColour(XMLElement& material) {
    XMLElement* colour = material.FirstChildElement("color");
    if (colour != nullptr && colour->Attribute("rgba") == nullptr) material.DeleteChild(colour);
  }

  void RepairMaterial(XMLElement& material) {
    DropEmptyColour(material);
    const char* name = material.Attribute("name");
    if (HasLook(material)) {
      if (name == nullptr || *name == '\0') {
        material.SetAttribute("name", ("unnamed_" + std::to_string(++unnamed_)).c_str());
      }
      return;
    }
    if (name != nullptr && materials_.count(name) != 0) return;
    LeaveOut(material, name == nullptr || *name == '\0' ? "it has neither a name nor a colour"
                                                        : "nothing defines it");
  }

  void RepairJoint(XMLElement& joint) {
    const char* type_text = joint.Attribute("type");
    const std::string type = type_text == nullptr ? "" : type_text;
    XMLElement* limit = joint.FirstChildElement("limit");
    if (limit == nullptr && type == "revolute") {
      Warn(joint, NameOfPart(joint) + " is revolute and has no <limit>; it rotates without limits");
      joint.SetAttribute("type", "continuous");
    } else if (limit == nullptr && type == "prismatic") {
      Warn(joint, NameOfPart(joint) + " is prismatic and has no <limit>; it slides without limits");
      limit = joint.InsertNewChildElement("limit");
      limit->SetAttribute("lower", "-1e16");
      limit->SetAttribute("upper", kNoUrdfLimit);
    }
    for (const char* key : {"effort", "velocity"}) {
      if (limit == nullptr || HasNumber(*limit, key)) continue;
      Warn(*limit,
           "<limit> of " + NameOfPart(joint) + " has no @" + key + "; no such limit applies");
      limit->SetAttribute(key, kNoUrdfLimit);
    }
    if (limit != nullptr && HasNumber(*limit, "lower") && HasNumber(*limit, "upper") &&
        limit->DoubleAttribute("lower") > limit->DoubleAttribute("upper")) {
      const std::string lower = limit->Attribute("lower"), upper = limit->Attribute("upper");
      Warn(*limit, "<limit> of " + NameOfPart(joint) + " has @lower " + lower + " above @upper " +
                       upper + "; they are swapped");
      limit->SetAttribute("lower", upper.c_str());
      limit->SetAttribute("upper", lower.c_str());
    }
    XMLElement* axis = joint.FirstChildElement("axis");
    if (axis != nullptr && axis->Attribute("xyz") != nullptr &&
        IsZeroVector(axis->Attribute("xyz"))) {
      Warn(*axis, "<axis> of " + NameOfPart(joint) + " has no direction; 1 0 0 is used");
      axis->SetAttribute("xyz", "1 0 0");
    }
    const auto drop = [&](const char* name, auto is_complete) {
      XMLElement* part = joint.FirstChildElement(name);
      if (part != nullptr && !is_complete(*part)) LeaveOut(*part, "it is incomplete");
    };
    drop("dynamics", [](const XMLElement& part) {
      return HasNumber(part, "damping") || HasNumber(part, "friction");
    });
    drop("mimic", [](const XMLElement& part) { return part.Attribute("joint") != nullptr; });
    drop("safety_controller", [](const XMLElement& part) { return HasNumber(part, "k_velocity"); });
  }

  void RepairExtension(XMLElement& extension) {
    XMLElement* next = nullptr;
    for (auto* child = extension.FirstChildElement(); child != nullptr; child = next) {
      next = child->NextSiblingElement();
      for (const char* name : kGazeboNumbers) {
        const char* text = Is(*child, name) ? child->GetText() : nullptr;
        const bool is_flag =
            text != nullptr && (std::strcmp(text, "true") == 0 || std::strcmp(text, "false") == 0);
        if (text == nullptr || is_flag) continue;
        const std::vector<std::string> words = WordsOf(text);
        if (!words.empty() && LeadingNumberOf(words.front()).is_number) continue;
        LeaveOut(*child, "its value is " + Quoted(text) + ", which is not a number");
        child = nullptr;
        break;
      }
      if (child != nullptr) RepairValues(*child, file_, problems_);
    }
  }

  const std::filesystem::path& file_;
  base::Problems& problems_;
  std::set<std::string> materials_;
  int unnamed_ = 0;
};

}  // namespace

void RepairUrdfParts(XMLElement& robot, const std::filesystem::path& file,
                     base::Problems& problems) {
  UrdfPartRepair(file, problems).Repair(robot);
}

void AddInertial(XMLElement& link, double mass) {
  XMLElement* inertial = link.InsertNewChildElement("inertial");
  inertial->InsertNewChildElement("mass")->SetAttribute("value", mass);
  WriteBall(*inertial->InsertNewChildElement("inertia"), mass);
}

}  // namespace gsv::formats
