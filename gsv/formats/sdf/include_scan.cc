#include "gsv/formats/sdf/include_scan.h"

#include <algorithm>
#include <system_error>

#include "gsv/formats/sdf/builtin_models.h"
#include "gsv/formats/sdf/urdf_text.h"
#include "gsv/formats/sdf/value_repair.h"

namespace gsv::formats {
namespace {

namespace fs = std::filesystem;
using base::ErrorCode;
using base::Problem;
using tinyxml2::XMLElement;

// Prefix of the names that GSV gives to included files. libsdformat requests the files by them.
constexpr char kIncluded[] = "gsv-included://";

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
         " is ignored: " + error.Sentence();
}

void InsertBuiltIn(XMLElement& include, std::string_view text) {
  tinyxml2::XMLDocument document;
  document.Parse(text.data(), text.size());
  auto* built_in = document.RootElement()->DeepClone(include.GetDocument())->ToElement();
  if (const auto* name = include.FirstChildElement("name"); name != nullptr && name->GetText()) {
    built_in->SetAttribute("name", name->GetText());
  }
  if (const auto* pose = include.FirstChildElement("pose")) {
    if (auto* own = built_in->FirstChildElement("pose")) built_in->DeleteChild(own);
    built_in->InsertFirstChild(pose->DeepClone(include.GetDocument()));
  }
  include.Parent()->InsertAfterChild(&include, built_in);
}

base::Result<fs::path> IncludeScan::FileOf(const std::string& uri, const fs::path& naming_file) {
  const auto key = std::make_pair(uri, naming_file.string());
  if (const auto known = found_.find(key); known != found_.end()) return known->second;
  auto found = finder_.Find(uri, naming_file);
  std::error_code error;
  if (found && fs::is_directory(*found, error)) found = ModelFileIn(*found);
  return found_.emplace(key, std::move(found)).first->second;
}

void IncludeScan::Scan(XMLElement& element, const fs::path& file) {
  open_ = {fs::absolute(file).lexically_normal()};
  Visit(element, file);
}

void IncludeScan::Visit(XMLElement& element, const fs::path& file) {
  XMLElement* next = nullptr;
  for (auto* child = element.FirstChildElement(); child != nullptr; child = next) {
    next = child->NextSiblingElement();
    if (std::string(child->Name()) != "include") {
      if (IsModelPart(*child)) Visit(*child, file);
      continue;
    }
    const std::string uri = UriOf(*child);
    const auto included = FileOf(uri, file);
    const auto name =
        included ? ReadIncluded(*included) : base::Result<std::string>(Fail(included.error()));
    if (name) {
      child->FirstChildElement("uri")->SetText(name->c_str());
    } else {
      ReplaceOrRemove(*child, uri, name.error(), file);
    }
  }
}

base::Result<std::string> IncludeScan::ReadIncluded(const fs::path& file) {
  const fs::path path = fs::absolute(file).lexically_normal();
  if (const auto first = std::find(open_.begin(), open_.end(), path); first != open_.end()) {
    std::string cycle;
    for (auto each = first; each != open_.end(); ++each) cycle += each->string() + " → ";
    return Fail(ErrorCode::kBadModel, "the includes form a cycle: " + cycle + path.string());
  }
  if (const auto known = done_.find(path); known != done_.end()) return known->second;
  if (open_.size() > static_cast<std::size_t>(limits_.include_depth)) {
    return Fail(
        ErrorCode::kBadModel,
        "files include each other deeper than " + std::to_string(limits_.include_depth) + " levels",
        path.string());
  }
  auto xml = ReadXml(path, finder_, limits_, problems_);
  if (xml) ReportUnsupported(*xml, problems_);
  open_.push_back(path);
  auto text = xml ? TextOf(*xml) : base::Result<std::string>(Fail(xml.error()));
  open_.pop_back();
  if (!text) return done_.emplace(path, Fail(text.error())).first->second;
  const std::string name = kIncluded + std::to_string(files_.size() + 1);
  files_[name] = {path, std::move(*text)};
  return done_.emplace(path, name).first->second;
}

// Returns the text of an included file, without the parts that cannot be read.
base::Result<std::string> IncludeScan::TextOf(XmlFile& file) {
  if (file.dialect == XmlDialect::kUrdf) return UrdfText(file, problems_);
  XMLElement* model = file.root->FirstChildElement("model");
  if (model == nullptr) {
    const XMLElement* content = file.root->FirstChildElement();
    return Fail(ErrorCode::kBadModel,
                content == nullptr ? std::string("the file contains no model")
                                   : "the file contains <" + std::string(content->Name()) +
                                         ">, but a model can include only models",
                file.path.string());
  }
  RepairValues(*model, file.path, problems_);
  Visit(*model, file.path);
  LineKeepingPrinter printer;
  printer.Text("<sdf version='" + file.version + "'>");
  printer.Element(*model);
  printer.Text("</sdf>");
  return printer.Take();
}

void IncludeScan::ReplaceOrRemove(XMLElement& include, const std::string& uri,
                                  const base::Error& error, const fs::path& file) {
  tinyxml2::XMLNode* parent = include.Parent();
  const std::string_view built_in = BuiltInModel(uri);
  if (built_in.empty()) {
    problems_.push_back(
        {Problem::Severity::kWarning, IncludeLeftOut(uri, error), PlaceOf(file, include)});
  } else if (built_in.substr(0, 6) == "<model") {
    InsertBuiltIn(include, built_in);
  }
  parent->DeleteChild(&include);
}

}  // namespace gsv::formats
