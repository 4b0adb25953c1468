#include "gsv/formats/sdf/document_repair.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <tinyxml2.h>
#include <sdf/Error.hh>

#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/formats/sdf/value_text.h"

namespace gsv::formats {
namespace {

using tinyxml2::XMLElement;

constexpr char kScope[] = "::";

// A parsed text, and whether its elements were changed.
struct Tree {
  SdfText* text;
  std::unique_ptr<tinyxml2::XMLDocument> document;
  bool is_changed = false;

  XMLElement* root() const { return document->RootElement(); }
};

std::vector<Tree> TreesOf(SdfText& document, IncludedFiles& includes) {
  std::vector<Tree> trees;
  const auto add = [&](SdfText& text) {
    auto parsed = std::make_unique<tinyxml2::XMLDocument>();
    if (parsed->Parse(text.text.data(), text.text.size()) != tinyxml2::XML_SUCCESS) return;
    const XMLElement* root = parsed->RootElement();
    if (root == nullptr || std::strcmp(root->Name(), "sdf") != 0) return;
    trees.push_back({&text, std::move(parsed)});
  };
  add(document);
  for (auto& [uri, text] : includes) add(text);
  return trees;
}

bool WriteChanged(const std::vector<Tree>& trees) {
  bool is_any = false;
  for (const Tree& tree : trees) {
    if (!tree.is_changed) continue;
    LineKeepingPrinter printer;
    printer.Element(*tree.root());
    tree.text->text = printer.Take();
    is_any = true;
  }
  return is_any;
}

void ForEach(XMLElement* element, const std::function<void(XMLElement&)>& visit) {
  for (; element != nullptr; element = element->NextSiblingElement()) {
    visit(*element);
    ForEach(element->FirstChildElement(), visit);
  }
}

bool IsNamed(const XMLElement& element, const std::string& kind, const std::string& name) {
  const char* own = element.Attribute("name");
  return own != nullptr && name == own && kind == element.Name();
}

std::string NameIn(const XMLElement& element) {
  const char* name = element.Attribute("name");
  return "<" + std::string(element.Name()) + ">" +
         (name == nullptr ? "" : " \"" + std::string(name) + "\"");
}

// Returns the texts in brackets, such as "a" of "link with name[a] already exists".
std::vector<std::string> Bracketed(const std::string& message) {
  std::vector<std::string> texts;
  for (std::size_t open = message.find('['); open != std::string::npos;
       open = message.find('[', open + 1)) {
    const std::size_t close = message.find(']', open);
    if (close == std::string::npos) break;
    texts.push_back(message.substr(open + 1, close - open - 1));
  }
  return texts;
}

// Returns the word before `after`: "link" for "specified by link with name[" and " with name[".
std::string WordBefore(const std::string& message, const std::string& after, std::size_t from = 0) {
  const std::size_t end = message.find(after, from);
  if (end == std::string::npos) return "";
  const std::size_t blank = message.rfind(' ', end == 0 ? 0 : end - 1);
  const std::size_t start = blank == std::string::npos ? 0 : blank + 1;
  return message.substr(start, end - start);
}

std::string WithoutScope(const std::string& name) {
  const std::size_t scope = name.rfind(kScope);
  return scope == std::string::npos ? name : name.substr(scope + std::strlen(kScope));
}

class DocumentRepair {
 public:
  DocumentRepair(SdfText& document, IncludedFiles& includes, base::Problems& problems)
      : trees_(TreesOf(document, includes)), problems_(problems) {}

  bool After(const sdf::Errors& errors) {
    if (trees_.empty()) return false;
    for (const sdf::Error& error : errors) AfterMeaning(error.Message());
    // libsdformat stops at the first element that it cannot read. The first error with a path names
    // this element.
    for (const sdf::Error& error : errors) {
      if (error.XmlPath() && !error.XmlPath()->empty() && LeaveOut(error)) break;
    }
    return WriteChanged(trees_);
  }

 private:
  void Warn(const Tree& tree, const XMLElement& element, const std::string& message) {
    problems_.push_back(
        {base::Problem::Severity::kWarning, message, PlaceOf(tree.text->path, element)});
  }

  // Calls `change` for all elements with this tag and name. `change` returns whether it has changed
  // the element.
  void ForNamed(const std::string& kind, const std::string& name,
                const std::function<bool(Tree&, XMLElement&)>& change) {
    for (Tree& tree : trees_) {
      std::vector<XMLElement*> found;
      ForEach(tree.root(), [&](XMLElement& element) {
        if (IsNamed(element, kind, name)) found.push_back(&element);
      });
      for (XMLElement* element : found) {
        if (change(tree, *element)) tree.is_changed = true;
      }
    }
  }

  void AfterMeaning(const std::string& message) {
    const std::vector<std::string> names = Bracketed(message);
    const auto says = [&](const char* text) { return message.find(text) != std::string::npos; };
    if (names.size() >= 3 && says("attached_to name[") && says("specified by frame")) {
      Detach(names[1], names[0]);
    } else if (names.size() >= 3 && says("relative_to name[") && says("specified by ")) {
      const std::size_t by = message.find("specified by ");
      MakeOwn(WordBefore(message, " with name[", by), names[1], names[0]);
    } else if (names.size() >= 3 && says("rame with name[") && says("specified by joint")) {
      LeaveOutJoint(names[1], "it names " + names[0] + ", which does not exist");
    } else if (names.size() >= 2 && says("Joint with name[") && says("must specify different")) {
      LeaveOutJoint(names[0], "its parent and its child are the same");
    } else if (names.size() >= 4 && says("joint with name[") && says("both resolve to")) {
      LeaveOutJoint(names[0], "its parent and its child are the same");
    } else if (names.size() >= 2 && says("canonical_link with name[")) {
      DropCanonicalLink(names[1], names[0]);
    } else if (names.size() == 1 && says(" with name[") && says("already exists")) {
      NameApart(WordBefore(message, " with name["), names[0]);
    } else if (names.size() == 1 && says("The supplied ") && says("is reserved")) {
      Rename(WordBefore(message, " name ["), names[0]);
    } else if (names.size() == 1 && says("cycle detected, already visited")) {
      BreakCircle(WithoutScope(names[0]));
    } else if (names.size() == 1 && says("unable to find unique frame with name")) {
      DropPlacementFrame(names[0]);
    }
  }

  void Detach(const std::string& frame, const std::string& missing) {
    ForNamed("frame", frame, [&](Tree& tree, XMLElement& element) {
      const char* attached = element.Attribute("attached_to");
      if (attached == nullptr || missing != attached) return false;
      Warn(tree, element,
           NameIn(element) + " is attached to " + missing +
               ", which does not exist; it is attached to the element that contains it");
      element.DeleteAttribute("attached_to");
      return true;
    });
  }

  // Makes the element's pose relative to its parent, because the pose's frame is missing.
  void MakeOwn(const std::string& kind, const std::string& name, const std::string& missing) {
    ForNamed(kind, name, [&](Tree& tree, XMLElement& element) {
      XMLElement* pose = element.FirstChildElement("pose");
      const char* other = pose == nullptr ? nullptr : pose->Attribute("relative_to");
      if (pose != nullptr && other == nullptr) other = pose->Attribute("frame");
      if (other == nullptr || missing != other) return false;
      Warn(tree, *pose,
           "the pose of " + NameIn(element) + " is relative to " + missing +
               ", which does not exist; it is treated as relative to the element that contains it");
      pose->DeleteAttribute("relative_to");
      pose->DeleteAttribute("frame");
      return true;
    });
  }

  void LeaveOutJoint(const std::string& name, const std::string& reason) {
    ForNamed("joint", name, [&](Tree& tree, XMLElement& element) {
      Warn(tree, element, "the joint \"" + name + "\" is ignored: " + reason);
      element.Parent()->DeleteChild(&element);
      return true;
    });
  }

  void DropCanonicalLink(const std::string& model, const std::string& link) {
    ForNamed("model", model, [&](Tree& tree, XMLElement& element) {
      const char* own = element.Attribute("canonical_link");
      if (own == nullptr || link != own) return false;
      Warn(tree, element,
           "the canonical link " + link + " of " + NameIn(element) +
               " does not exist; its first link is used");
      element.DeleteAttribute("canonical_link");
      return true;
    });
  }

  // If siblings have the same name, renames all of them except the first.
  void NameApart(const std::string& kind, const std::string& name) {
    for (Tree& tree : trees_) {
      std::set<const tinyxml2::XMLNode*> parents;
      ForEach(tree.root(), [&](XMLElement& element) {
        if (!IsNamed(element, kind, name)) return;
        if (parents.insert(element.Parent()).second) return;
        SetFreeName(tree, element, "there is a second " + NameIn(element));
      });
    }
  }

  void Rename(const std::string& kind, const std::string& name) {
    ForNamed(kind, name, [&](Tree& tree, XMLElement& element) {
      const std::string free =
          SetFreeName(tree, element, "the name of " + NameIn(element) + " is reserved");
      ForEach(element.Parent()->FirstChildElement(), [&](XMLElement& other) {
        const bool refers =
            std::strcmp(other.Name(), "parent") == 0 || std::strcmp(other.Name(), "child") == 0;
        if (refers && other.GetText() != nullptr && name == other.GetText()) {
          other.SetText(free.c_str());
        }
        for (const char* attribute : {"relative_to", "attached_to", "canonical_link"}) {
          const char* value = other.Attribute(attribute);
          if (value != nullptr && name == value) other.SetAttribute(attribute, free.c_str());
        }
      });
      return true;
    });
  }

  std::string SetFreeName(Tree& tree, XMLElement& element, const std::string& reason) {
    std::set<std::string> taken;
    for (const auto* each = element.Parent()->FirstChildElement(); each != nullptr;
         each = each->NextSiblingElement()) {
      if (const char* name = each->Attribute("name")) taken.insert(name);
    }
    const std::string old = element.Attribute("name");
    std::string name = old + "_1";
    for (int i = 2; taken.count(name) != 0; ++i) name = old + "_" + std::to_string(i);
    Warn(tree, element, reason + "; it is named " + name);
    element.SetAttribute("name", name.c_str());
    tree.is_changed = true;
    return name;
  }

  void BreakCircle(const std::string& name) {
    for (const char* kind : {"link", "frame", "joint", "model"}) {
      ForNamed(kind, name, [&](Tree& tree, XMLElement& element) {
        XMLElement* pose = element.FirstChildElement("pose");
        if (pose == nullptr || pose->Attribute("relative_to") == nullptr) return false;
        Warn(tree, *pose,
             "the pose of " + NameIn(element) +
                 " is relative to itself through other frames; it is treated as relative to the "
                 "element that contains it");
        pose->DeleteAttribute("relative_to");
        return true;
      });
    }
  }

  void DropPlacementFrame(const std::string& name) {
    for (Tree& tree : trees_) {
      ForEach(tree.root(), [&](XMLElement& element) {
        const char* attribute = element.Attribute("placement_frame");
        XMLElement* child = element.FirstChildElement("placement_frame");
        const bool has_child =
            child != nullptr && child->GetText() != nullptr && name == child->GetText();
        if (!has_child && (attribute == nullptr || name != attribute)) return;
        Warn(tree, element,
             "there is no frame \"" + name + "\" for the pose of " + NameIn(element) +
                 "; its own frame is used");
        element.DeleteAttribute("placement_frame");
        if (has_child) element.DeleteChild(child);
        tree.is_changed = true;
      });
    }
  }

  // Returns the element at a path such as "/sdf/world[@name="w"]/model[@name="m"]/link", or its
  // nearest existing ancestor.
  static XMLElement* Follow(XMLElement* root, const std::string& path, int line) {
    XMLElement* at = nullptr;
    std::size_t from = 0;
    while (from < path.size()) {
      const std::size_t name_end = path.find_first_of("/[", from + 1);
      const std::string kind = path.substr(from + 1, name_end - from - 1);
      std::optional<std::string> name;
      from = name_end;
      if (from != std::string::npos && path[from] == '[') {
        const std::size_t open = path.find('"', from);
        const std::size_t close = path.find("\"]", open + 1);
        if (open == std::string::npos || close == std::string::npos) return nullptr;
        name = path.substr(open + 1, close - open - 1);
        from = close + 2;
      }
      XMLElement* child = at == nullptr ? root : at->FirstChildElement(kind.c_str());
      const auto fits = [&](const XMLElement& element) {
        const char* own = element.Attribute("name");
        return !name || (own != nullptr && *name == own);
      };
      while (child != nullptr && !fits(*child)) child = child->NextSiblingElement(kind.c_str());
      if (child == nullptr) return at;
      at = child;
      if (from == std::string::npos) break;
    }
    // If several elements match, the error is about the element on the error's line.
    for (XMLElement* same = at; same != nullptr && line > 0;
         same = same->NextSiblingElement(at->Name())) {
      if (same->GetLineNum() == line) return same;
    }
    return at;
  }

  bool LeaveOut(const sdf::Error& error) {
    for (Tree& tree : trees_) {
      const std::string file = error.FilePath().value_or("");
      const bool is_here = file.empty() || file.front() == '<' ? &tree == &trees_.front()
                                                               : file == tree.text->path.string();
      if (!is_here) continue;
      XMLElement* element = Follow(tree.root(), *error.XmlPath(), error.LineNumber().value_or(0));
      if (element == nullptr || IsTop(*element)) continue;
      Warn(tree, *element, NameIn(*element) + WhyUnreadable(*element, error.Message()));
      element->Parent()->DeleteChild(element);
      tree.is_changed = true;
      return true;
    }
    return false;
  }

  // Returns the reason for leaving out an element. If libsdformat's message is only a summary,
  // returns the element's value instead.
  static std::string WhyUnreadable(const XMLElement& element, const std::string& message) {
    if (element.GetText() != nullptr && message.rfind("Error reading element", 0) == 0) {
      return " holds " + Quoted(element.GetText()) + ", which cannot be read; it is ignored";
    }
    return " cannot be read and is ignored: " + message.substr(0, 200);
  }

  // Whether the element must not be removed, because nothing would be left.
  static bool IsTop(const XMLElement& element) {
    const auto* parent = element.Parent()->ToElement();
    return parent == nullptr || std::strcmp(parent->Name(), "sdf") == 0;
  }

  std::vector<Tree> trees_;
  base::Problems& problems_;
};

}  // namespace

bool RepairAfter(const sdf::Errors& errors, SdfText& document, IncludedFiles& includes,
                 base::Problems& problems) {
  if (errors.empty()) return false;
  return DocumentRepair(document, includes, problems).After(errors);
}

namespace {

// Whether the element is in a <plugin>. Names such as gz::sim::systems::Physics stay unchanged
// there.
bool IsInPlugin(const XMLElement& element) {
  for (const tinyxml2::XMLNode* at = &element; at != nullptr; at = at->Parent()) {
    if (at->ToElement() != nullptr && std::strcmp(at->Value(), "plugin") == 0) return true;
  }
  return false;
}

// Changes the names in an element: its own name, and the names to which it refers.
void ChangeNames(Tree& tree, XMLElement& element,
                 const std::function<std::string(const std::string&)>& changed) {
  if (IsInPlugin(element)) return;
  for (const char* key : {"name", "relative_to", "attached_to", "frame", "expressed_in",
                          "canonical_link", "placement_frame"}) {
    const char* value = element.Attribute(key);
    if (value == nullptr || std::strstr(value, kScope) == nullptr) continue;
    const std::string name = changed(value);
    if (name == value) continue;
    element.SetAttribute(key, name.c_str());
    tree.is_changed = true;
  }
  const bool refers =
      std::strcmp(element.Name(), "parent") == 0 || std::strcmp(element.Name(), "child") == 0;
  if (!refers || element.GetText() == nullptr) return;
  const std::string text = changed(element.GetText());
  if (text == element.GetText()) return;
  element.SetText(text.c_str());
  tree.is_changed = true;
}

std::string WithDots(std::string text) {
  for (std::size_t at = 0; (at = text.find(kScope, at)) != std::string::npos;) {
    text.replace(at, std::strlen(kScope), ".");
  }
  return text;
}

// Whether "::" in names is reserved in the version of a file.
bool ReservesScope(const XMLElement& sdf) {
  constexpr int kFirstMinor = 8;
  const char* version = sdf.Attribute("version");
  int major = 0, minor = 0;
  return version != nullptr && std::sscanf(version, "%d.%d", &major, &minor) == 2 &&
         (major > 1 || minor >= kFirstMinor);
}

// Whether an attribute of an element contains "::". Elements of plugins do not count.
bool HasScopeInAttribute(const std::string& text) {
  for (std::size_t at = 0; (at = text.find(kScope, at)) != std::string::npos; ++at) {
    const std::size_t bracket = text.find_last_of("<>", at);
    if (bracket == std::string::npos || text[bracket] == '>') continue;
    if (text.compare(bracket, 7, "<plugin") != 0) return true;
  }
  return false;
}

}  // namespace

bool SeparateNames(SdfText& document, IncludedFiles& includes, base::Problems& problems) {
  std::vector<Tree> trees = TreesOf(document, includes);
  for (Tree& tree : trees) {
    ForEach(tree.root(), [&](XMLElement& element) { ChangeNames(tree, element, WithDots); });
    if (!tree.is_changed) continue;
    problems.push_back(
        {base::Problem::Severity::kWarning,
         "names with \"::\" are read with \".\" instead, because poses there are relative "
         "to elements outside",
         tree.text->path.string()});
  }
  return WriteChanged(trees);
}

bool MayHaveReservedNames(const SdfText& document, const IncludedFiles& includes) {
  return HasScopeInAttribute(document.text) ||
         std::any_of(includes.begin(), includes.end(),
                     [](const auto& include) { return HasScopeInAttribute(include.second.text); });
}

void SeparateReservedNames(SdfText& document, IncludedFiles& includes, base::Problems& problems) {
  std::vector<Tree> trees = TreesOf(document, includes);
  for (Tree& tree : trees) {
    if (!ReservesScope(*tree.root())) continue;
    // In descending order, a name comes before its prefixes. So the longest name that matches is
    // replaced.
    std::set<std::string, std::greater<>> names;
    ForEach(tree.root(), [&](XMLElement& element) {
      const char* name = element.Attribute("name");
      if (name == nullptr || std::strstr(name, kScope) == nullptr || IsInPlugin(element)) return;
      if (!names.insert(name).second) return;
      problems.push_back(
          {base::Problem::Severity::kWarning,
           "the name " + Quoted(name) + " contains \"::\"; " + Quoted(WithDots(name)) + " is used",
           PlaceOf(tree.text->path, element)});
    });
    const auto changed = [&names](const std::string& text) {
      for (const std::string& name : names) {
        const std::size_t at = text.find(name);
        if (at == std::string::npos) continue;
        return text.substr(0, at) + WithDots(name) + text.substr(at + name.size());
      }
      return text;
    };
    ForEach(tree.root(), [&](XMLElement& element) { ChangeNames(tree, element, changed); });
  }
  WriteChanged(trees);
}

}  // namespace gsv::formats
