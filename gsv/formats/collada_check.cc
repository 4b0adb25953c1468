#include "gsv/formats/collada_check.h"

#include <cctype>
#include <cstring>

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

class Checker : public tinyxml2::XMLVisitor {
 public:
  explicit Checker(std::size_t bytes) : bytes_(static_cast<double>(bytes)) {}

  bool VisitEnter(const XMLElement& element, const tinyxml2::XMLAttribute* first) override {
    line = element.GetLineNum();
    for (auto* attribute = first; attribute != nullptr; attribute = attribute->Next()) {
      const char* name = attribute->Name();
      const bool counts = std::strcmp(name, "count") == 0 || std::strcmp(name, "stride") == 0 ||
                          std::strcmp(name, "offset") == 0;
      if (counts && !(attribute->DoubleValue() <= bytes_)) {
        wrong = "the mesh claims more values than the file holds";
      }
    }
    if (IsListOfIndices(element) && !HoldsWholeNumbers(element.GetText())) {
      wrong = "a list of indices holds something that is no whole number";
    }
    return wrong == nullptr;
  }

  const char* wrong = nullptr;
  int line = 0;

 private:
  double bytes_;
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
  if (checker.wrong == nullptr) return {};
  return Fail(ErrorCode::kBadModel, checker.wrong, file + ":" + std::to_string(checker.line));
}

}  // namespace gsv::formats
