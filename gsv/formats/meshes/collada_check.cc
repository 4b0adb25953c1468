#include "gsv/formats/meshes/collada_check.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

namespace gsv::formats {
namespace {

using base::ErrorCode;
using tinyxml2::XMLElement;

bool IsDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool IsBlank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

bool HoldsWholeNumbers(const char* text) {
  while (text != nullptr && *text != '\0') {
    while (IsBlank(*text)) ++text;
    if (*text == '\0') break;
    if (*text == '-' || *text == '+') ++text;
    if (!IsDigit(*text)) return false;
    while (IsDigit(*text)) ++text;
    if (*text != '\0' && !IsBlank(*text)) return false;
  }
  return true;
}

bool IsListOfIndices(const XMLElement& element) {
  const char* name = element.Name();
  return std::strcmp(name, "p") == 0 || std::strcmp(name, "vcount") == 0 ||
         std::strcmp(name, "v") == 0 || std::strcmp(name, "h") == 0;
}

// An accessor reads values of an array: COLLADA 1.4.1, 5-16 (accessor) and 5-56 (float_array).
struct Accessor {
  std::string array;  // id of the array
  double values = 0;  // number of values that the array must have; infinite if there is no count
  int line = 0;
};

// Returns the count in an attribute. Returns `absent` if there is no such attribute, and `odd` if
// its text has characters other than digits. assimp reads such a text differently from other
// programs.
double CountIn(const XMLElement& element, const char* attribute, double absent, double odd) {
  const char* text = element.Attribute(attribute);
  if (text == nullptr) return absent;
  const bool is_count = *text != '\0' && std::all_of(text, text + std::strlen(text), IsDigit);
  return is_count ? element.DoubleAttribute(attribute) : odd;
}

Accessor AccessorIn(const XMLElement& element) {
  constexpr double kTooMany = 1e300;
  double params = 0;
  for (auto* param = element.FirstChildElement("param"); param != nullptr;
       param = param->NextSiblingElement("param")) {
    ++params;
  }
  const char* source = element.Attribute("source");
  const double count = CountIn(element, "count", kTooMany, kTooMany);
  const double stride = CountIn(element, "stride", 1, kTooMany);
  const double last = CountIn(element, "offset", 0, kTooMany) + (count - 1) * stride;
  return {source != nullptr && *source == '#' ? source + 1 : "",
          count > 0 ? last + std::max(stride, params) : 0, element.GetLineNum()};
}

// A graph of the nodes that other nodes contain, by <node> and by <instance_node> (COLLADA 1.4.1,
// 5-68). assimp copies each instance with all its content. assimp does not terminate if a node
// contains itself.
class NodeGraph {
 public:
  // Adds an <instance_node>. `inside`: the ids of the nodes that contain the element, outermost
  // first.
  void AddInstance(const std::vector<std::string>& inside, const std::string& url) {
    if (url.empty() || url.front() != '#') return;
    for (const std::string& node : inside) contents_[node].push_back(url.substr(1));
  }

  // Returns the first fault as a sentence; null if there is none.
  const char* Fault() {
    for (const auto& [node, contents] : contents_) {
      if (CopiesOf(node, 0) > kMaxCopies && fault_ == nullptr)
        fault_ = "its nodes contain more than 1000000 nodes";
      if (fault_ != nullptr) break;
    }
    return fault_;
  }

 private:
  static constexpr int kMaxInstanceDepth = 64;
  static constexpr double kMaxCopies = 1e6;

  // Returns the number of nodes that a copy of this node has, including itself.
  double CopiesOf(const std::string& node, int depth) {
    if (const auto known = copies_.find(node); known != copies_.end()) return known->second;
    const auto contents = contents_.find(node);
    if (contents == contents_.end() || fault_ != nullptr) return 1;
    if (depth == kMaxInstanceDepth || !open_.insert(node).second) {
      fault_ = depth == kMaxInstanceDepth ? "its nodes are nested deeper than 64 levels"
                                          : "one of its nodes contains itself";
      return 1;
    }
    double copies = 1;
    for (const std::string& inner : contents->second) copies += CopiesOf(inner, depth + 1);
    open_.erase(node);
    return copies_[node] = copies;
  }

  std::map<std::string, std::vector<std::string>> contents_;
  std::map<std::string, double> copies_;
  std::set<std::string> open_;
  const char* fault_ = nullptr;
};

class Checker : public tinyxml2::XMLVisitor {
 public:
  explicit Checker(std::size_t bytes) : bytes_(static_cast<double>(bytes)) {}

  bool VisitEnter(const XMLElement& element, const tinyxml2::XMLAttribute* first) override {
    line = element.GetLineNum();
    const std::string_view name = element.Name();
    if (const char* id = element.Attribute("id"); id != nullptr && name.ends_with("_array")) {
      const double values = CountIn(element, "count", 0, 0);
      const auto [known, is_new] = arrays_.try_emplace(id, values);
      if (!is_new) known->second = std::min(known->second, values);
    }
    if (name == "accessor") accessors_.push_back(AccessorIn(element));
    if (name == "node")
      nodes_.push_back(element.Attribute("id") == nullptr ? "" : element.Attribute("id"));
    if (name == "instance_node" && element.Attribute("url") != nullptr) {
      graph_.AddInstance(nodes_, element.Attribute("url"));
    }
    for (auto* attribute = first; attribute != nullptr; attribute = attribute->Next()) {
      const std::string_view key = attribute->Name();
      const bool counts = key == "count" || key == "stride" || key == "offset";
      if (counts && !(attribute->DoubleValue() >= 0 && attribute->DoubleValue() <= bytes_)) {
        wrong = "the mesh declares more values than the file contains";
      }
    }
    if (IsListOfIndices(element) && !HoldsWholeNumbers(element.GetText())) {
      wrong = "a list of indices contains something other than whole numbers";
    }
    return wrong == nullptr;
  }

  bool VisitExit(const XMLElement& element) override {
    if (std::string_view(element.Name()) == "node" && !nodes_.empty()) nodes_.pop_back();
    return wrong == nullptr;
  }

  void CheckNodes() {
    if (wrong == nullptr) wrong = graph_.Fault();
  }

  // Call this at the end, because arrays may come after their accessors.
  void CheckAccessors() {
    for (const Accessor& accessor : accessors_) {
      const auto array = arrays_.find(accessor.array);
      if (wrong != nullptr || array == arrays_.end() || accessor.values <= array->second) continue;
      wrong = "an accessor reads more values than its array contains";
      line = accessor.line;
    }
  }

  const char* wrong = nullptr;
  int line = 0;

 private:
  double bytes_;
  // number of values of each array, by id; the smallest number, if several arrays have the id
  std::map<std::string, double> arrays_;
  std::vector<Accessor> accessors_;
  std::vector<std::string> nodes_;  // the ids of the nodes that contain the visited element
  NodeGraph graph_;
};

}  // namespace

base::Status CheckCollada(const std::string& text, const std::string& file) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    return Fail(ErrorCode::kBadModel, "the mesh cannot be read: its XML is malformed",
                file + ":" + std::to_string(document.ErrorLineNum()));
  }
  Checker checker(text.size());
  document.Accept(&checker);
  checker.CheckAccessors();
  checker.CheckNodes();
  if (checker.wrong == nullptr) return {};
  return Fail(ErrorCode::kBadModel, checker.wrong, file + ":" + std::to_string(checker.line));
}

}  // namespace gsv::formats
