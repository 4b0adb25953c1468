#include "gsv/formats/sdf/include_scan.h"

#include <algorithm>
#include <system_error>

#include "gsv/formats/sdf/builtin_models.h"
#include "gsv/formats/sdf/sdf_xml.h"

namespace gsv::formats {
namespace {

namespace fs = std::filesystem;
using base::ErrorCode;
using base::Problem;
using tinyxml2::XMLElement;

bool IsModelPart(const XMLElement& element) {
  const std::string name = element.Name();
  return name == "model" || name == "sdf" || name == "world";
}

}  // namespace

std::string UriOf(const XMLElement& include) {
  const XMLElement* uri = include.FirstChildElement("uri");
  std::string text = uri != nullptr && uri->GetText() != nullptr ? uri->GetText() : "";
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string IncludeLeftOut(const std::string& uri, const base::Error& error) {
  return "the include of " + (uri.empty() ? std::string("nothing") : uri) +
         " is left out: " + error.message;
}

base::Result<fs::path> IncludeScan::FileOf(const std::string& uri, const fs::path& naming_file) {
  const auto key = std::make_pair(uri, naming_file.string());
  if (const auto known = found_.find(key); known != found_.end()) return known->second;
  auto found = finder_.Find(uri, naming_file);
  std::error_code error;
  if (found && fs::is_directory(*found, error)) found = ModelFileIn(*found);
  return found_.emplace(key, std::move(found)).first->second;
}

base::Status IncludeScan::Scan(XMLElement& element, const fs::path& file) {
  open_ = {fs::absolute(file).lexically_normal()};
  return Visit(element, file);
}

base::Status IncludeScan::Visit(XMLElement& element, const fs::path& file) {
  XMLElement* next = nullptr;
  for (auto* child = element.FirstChildElement(); child != nullptr; child = next) {
    next = child->NextSiblingElement();
    if (std::string(child->Name()) != "include") {
      if (!IsModelPart(*child)) continue;
      if (auto status = Visit(*child, file); !status) return status;
      continue;
    }
    const std::string uri = UriOf(*child);
    auto included = FileOf(uri, file);
    if (!included) {
      ReplaceOrRemove(*child, uri, included.error(), file);
      continue;
    }
    files_.emplace(uri, *included);
    if (auto status = Enter(*included); !status) return status;
  }
  return {};
}

base::Status IncludeScan::Enter(const fs::path& file) {
  const fs::path path = fs::absolute(file).lexically_normal();
  if (std::find(open_.begin(), open_.end(), path) != open_.end()) {
    return Fail(ErrorCode::kBadModel, "the includes go round: this file includes itself",
                path.string());
  }
  if (open_.size() > static_cast<std::size_t>(limits_.include_depth)) {
    return Fail(ErrorCode::kBadModel,
                "files include each other deeper than " + std::to_string(limits_.include_depth),
                path.string());
  }
  if (!done_.emplace(path, true).second) return {};
  base::Problems ignored;  // libsdformat reads the file and says what is wrong with it
  auto xml = ReadXml(path, finder_, limits_, ignored);
  if (!xml) return Fail(xml.error());
  ReportUnsupported(*xml, problems_);
  open_.push_back(path);
  auto status = Visit(*xml->root, path);
  open_.pop_back();
  return status;
}

void IncludeScan::ReplaceOrRemove(XMLElement& include, const std::string& uri,
                                  const base::Error& error, const fs::path& file) {
  tinyxml2::XMLNode* parent = include.Parent();
  const std::string_view built_in = BuiltInModel(uri);
  if (built_in.empty()) {
    problems_.push_back(
        {Problem::Severity::kWarning, IncludeLeftOut(uri, error), PlaceOf(file, include)});
  } else if (built_in.substr(0, 6) == "<model") {
    tinyxml2::XMLDocument document;
    document.Parse(built_in.data(), built_in.size());
    parent->InsertAfterChild(&include, document.RootElement()->DeepClone(include.GetDocument()));
  }
  parent->DeleteChild(&include);
}

}  // namespace gsv::formats
