#include "gsv/formats/support/naming_rules.h"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "gsv/formats/support/element_path.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;

constexpr int kMaxSteps = 100;  // maximum number of steps from frame to frame

std::string Trimmed(const char* text) {
  const std::string_view whole = text == nullptr ? std::string_view() : text;
  const std::size_t first = whole.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return std::string(whole.substr(first, whole.find_last_not_of(" \t\r\n") - first + 1));
}

std::string NameOf(const XMLElement& element) { return Trimmed(element.Attribute("name")); }

std::string TrimmedText(const XMLElement& element, const char* child) {
  const XMLElement* found = element.FirstChildElement(child);
  return found == nullptr ? std::string() : Trimmed(found->GetText());
}

std::string RelativeTo(const XMLElement& element) {
  const XMLElement* pose = element.FirstChildElement("pose");
  return pose == nullptr ? std::string() : Trimmed(pose->Attribute("relative_to"));
}

bool IsOneOf(std::string_view kind, std::initializer_list<std::string_view> kinds) {
  for (const std::string_view each : kinds) {
    if (kind == each) return true;
  }
  return false;
}

bool IsReserved(const std::string& name) {
  return name == "world" ||
         (name.size() >= 4 && name.substr(0, 2) == "__" && name.substr(name.size() - 2) == "__");
}

// The names of siblings in a model or in a world.
struct Scope {
  std::map<std::string, const XMLElement*> names;
  bool is_open = false;  // whether an include adds names that are not known here

  // Whether an element with that name may exist. Names of parts of nested models are not checked.
  bool Has(const std::string& name) const {
    if (is_open || name.empty() || IsReserved(name)) return true;
    return names.count(name) != 0 || names.count(name.substr(0, name.find("::"))) != 0;
  }
  const XMLElement* Find(const std::string& name) const {
    const auto it = names.find(name);
    return it == names.end() ? nullptr : it->second;
  }
};

class NamingRules {
 public:
  NamingRules(const AuditedFile& file, base::Problems& problems)
      : file_(file), problems_(problems) {}

  void Run() {
    std::set<std::string> worlds;
    for (auto* child = file_.root->FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const std::string_view kind = child->Name();
      if (kind == "world") {
        if (!worlds.insert(NameOf(*child)).second) {
          Report("there is a second world \"" + NameOf(*child) + "\"", *child);
        }
        CheckScope(*child, {"model", "light", "frame", "actor", "joint"});
      } else if (kind == "model") {
        CheckName(*child);
        CheckModel(*child);
      }
    }
  }

 private:
  void Report(std::string message, const XMLElement& element) {
    if (reported_++ >= kMaxFindings) return;
    problems_.push_back({base::Problem::Severity::kError, std::move(message),
                         PlaceOf(file_.path, element) + ": " + PathOf(element)});
  }

  void CheckName(const XMLElement& element) {
    const std::string name = NameOf(element);
    if (name.empty()) {
      Report("a <" + std::string(element.Name()) + "> needs a name", element);
    } else if (IsReserved(name)) {
      Report("the name \"" + name + "\" is reserved", element);
    }
  }

  void CheckModel(const XMLElement& model) {
    if (model.FirstChildElement("link") == nullptr && model.FirstChildElement("model") == nullptr &&
        model.FirstChildElement("include") == nullptr) {
      Report("a model needs a link", model);
    }
    CheckScope(model, {"link", "joint", "frame", "model"});
  }

  void CheckScope(const XMLElement& owner, std::initializer_list<std::string_view> kinds) {
    Scope scope;
    for (auto* child = owner.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      const std::string_view kind = child->Name();
      if (kind == "include") {
        AddInclude(*child, scope);
      } else if (IsOneOf(kind, kinds)) {
        CheckName(*child);
        AddName(NameOf(*child), *child, scope);
      }
    }
    if (const char* canonical = owner.Attribute("canonical_link")) {
      CheckReference("canonical_link", Trimmed(canonical), owner, scope);
    }
    for (auto* child = owner.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      CheckPart(*child, scope);
    }
    CheckCycles(scope);
  }

  static void AddInclude(const XMLElement& include, Scope& scope) {
    const std::string name = TrimmedText(include, "name");
    if (name.empty() || include.BoolAttribute("merge", false)) {
      scope.is_open = true;
    } else {
      scope.names.emplace(name, &include);
    }
  }

  void AddName(const std::string& name, const XMLElement& element, Scope& scope) {
    if (name.empty()) return;
    const auto [it, is_new] = scope.names.emplace(name, &element);
    if (is_new) return;
    Report("the name \"" + name + "\" is that of a <" + it->second->Name() +
               "> with the same parent; siblings must have different names",
           element);
  }

  void CheckPart(const XMLElement& part, const Scope& scope) {
    const std::string_view kind = part.Name();
    CheckReference("relative_to", RelativeTo(part), part, scope);
    if (kind == "link") {
      CheckLink(part, scope);
    } else if (kind == "joint") {
      CheckJoint(part, scope);
    } else if (kind == "frame") {
      CheckReference("attached_to", Trimmed(part.Attribute("attached_to")), part, scope);
    } else if (kind == "model") {
      CheckModel(part);
    }
  }

  // Checks that the collisions, and the visuals, of a link have different names.
  void CheckLink(const XMLElement& link, const Scope& scope) {
    std::set<std::pair<std::string, std::string>> names;
    for (auto* child = link.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      if (!IsOneOf(child->Name(), {"collision", "visual", "sensor", "light"})) continue;
      CheckName(*child);
      CheckReference("relative_to", RelativeTo(*child), *child, scope);
      const std::string name = NameOf(*child);
      if (!name.empty() && !names.insert({child->Name(), name}).second) {
        Report(
            "there is a second <" + std::string(child->Name()) + "> \"" + name + "\" in the link",
            *child);
      }
    }
  }

  void CheckJoint(const XMLElement& joint, const Scope& scope) {
    const std::string parent = TrimmedText(joint, "parent"), child = TrimmedText(joint, "child");
    CheckReference("parent", parent, joint, scope);
    CheckReference("child", child, joint, scope);
    if (child == "world") Report("a joint's child cannot be the world", joint);
    const std::string parent_link = LinkOf(parent, scope), child_link = LinkOf(child, scope);
    if (!parent.empty() && parent == child) {
      Report("a joint cannot join \"" + parent + "\" to itself", joint);
    } else if (!parent_link.empty() && parent_link == child_link) {
      Report("the joint's parent and child are the same link, \"" + child_link + "\"", joint);
    }
    for (const char* axis : {"axis", "axis2"}) {
      const XMLElement* element = joint.FirstChildElement(axis);
      const XMLElement* xyz = element == nullptr ? nullptr : element->FirstChildElement("xyz");
      if (xyz == nullptr) continue;
      CheckReference("expressed_in", Trimmed(xyz->Attribute("expressed_in")), joint, scope);
    }
  }

  void CheckReference(const char* what, const std::string& name, const XMLElement& element,
                      const Scope& scope) {
    if (scope.Has(name)) return;
    Report("its " + std::string(what) + " names \"" + name + "\", which does not exist", element);
  }

  // Returns the link to which a frame or joint with that name is attached; empty if it is not
  // known.
  static std::string LinkOf(std::string name, const Scope& scope) {
    for (int step = 0; step < kMaxSteps; ++step) {
      const XMLElement* element = scope.Find(name);
      if (element == nullptr) return {};
      const std::string_view kind = element->Name();
      if (kind == "link") return name;
      if (kind == "frame") {
        name = Trimmed(element->Attribute("attached_to"));
      } else if (kind == "joint") {
        name = TrimmedText(*element, "child");
      } else {
        return {};
      }
    }
    return {};
  }

  // Returns the frame to which an element is attached (if `attachment`), or the frame to which its
  // pose is relative (if not).
  static std::string Next(const XMLElement& element, bool attachment) {
    const std::string_view kind = element.Name();
    const std::string relative_to = attachment ? std::string() : RelativeTo(element);
    if (!relative_to.empty()) return relative_to;
    if (kind == "frame") return Trimmed(element.Attribute("attached_to"));
    if (kind == "joint") return TrimmedText(element, "child");
    return {};
  }

  // Reports elements whose frames form a cycle. Visits each name once.
  void CheckCycles(const Scope& scope) {
    std::set<std::string> reported;
    for (const bool attachment : {false, true}) {
      std::set<std::string> passed;
      for (const auto& [name, element] : scope.names) {
        std::set<std::string> way;
        std::string at = name;
        while (const XMLElement* here = scope.Find(at)) {
          if (passed.count(at) != 0) break;
          if (!way.insert(at).second) {
            ReportCircle(at, attachment, scope, reported);
            break;
          }
          at = Next(*here, attachment);
        }
        passed.merge(way);
      }
    }
  }

  void ReportCircle(const std::string& start, bool attachment, const Scope& scope,
                    std::set<std::string>& reported) {
    std::string at = start;
    do {
      const XMLElement& element = *scope.Find(at);
      if (reported.insert(at).second) {
        Report("the frames that \"" + at + "\" is attached to form a cycle", element);
      }
      at = Next(element, attachment);
    } while (at != start);
  }

  const AuditedFile& file_;
  base::Problems& problems_;
  int reported_ = 0;
};

}  // namespace

void CheckNamingRules(const AuditedFile& file, base::Problems& problems) {
  if (file.minor_version != 0) NamingRules(file, problems).Run();
}

}  // namespace gsv::formats
