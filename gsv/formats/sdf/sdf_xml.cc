#include "gsv/formats/sdf/sdf_xml.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>
#include <system_error>

#include "gsv/formats/files/xml_text.h"
#include "gsv/formats/support/element_audit.h"
#include "gsv/formats/xacro/arguments.h"
#include "gsv/formats/xacro/xacro.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using base::Problem;
using tinyxml2::XMLElement;

constexpr int kOldestVersion = 103;
constexpr int kNewestVersion = 109;  // SDFormat 1.9, the newest version of libsdformat 12
constexpr int kNewestKnownMinor = 12;
constexpr int kNewestKnown = 100 + kNewestKnownMinor;

base::Result<std::string> ReadText(const std::filesystem::path& path, std::size_t limit) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return Fail(ErrorCode::kBadModel, "there is no such file", path.string());
  }
  const auto size = std::filesystem::file_size(path, error);
  if (error || size > limit) {
    return Fail(ErrorCode::kBadModel,
                "the file is larger than the limit of " + std::to_string(limit) + " bytes",
                path.string());
  }
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.good() && !file.eof()) {
    return Fail(ErrorCode::kBadModel, "the file cannot be read", path.string());
  }
  return text;
}

int Depth(const XMLElement& element, int limit) {
  int deepest = 0;
  if (limit <= 0) return 1;
  for (auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    deepest = std::max(deepest, Depth(*child, limit - 1));
  }
  return deepest + 1;
}

base::Status CheckVersion(XmlFile& file, base::Problems& problems) {
  const char* version = file.root->Attribute("version");
  int major = 0, minor = 0;
  if (version == nullptr || std::sscanf(version, "%d.%d", &major, &minor) != 2) {
    return Fail(ErrorCode::kBadModel, "<sdf> needs a version, such as version=\"1.9\"",
                PlaceOf(file.path, *file.root));
  }
  file.version = version;
  const int number = major * 100 + minor;
  if (number < kOldestVersion) {
    return Fail(ErrorCode::kBadModel,
                "SDFormat " + file.version + " is not supported; convert the file to 1.4 or newer",
                PlaceOf(file.path, *file.root));
  }
  file.minor_version = major == 1 ? minor : kNewestKnownMinor;
  if (number > kNewestKnown) {
    problems.push_back(
        {Problem::Severity::kWarning,
         "SDFormat " + file.version +
             " is newer than 1.12, the newest known version; its new elements are ignored",
         PlaceOf(file.path, *file.root)});
  }
  if (number > kNewestVersion) {
    file.version = "1.9";
    file.root->SetAttribute("version", "1.9");
  }
  return {};
}

// Sets the user data of each element to its ElementSource, in the order of the document.
void NameSources(XMLElement& element, std::vector<ElementSource>& sources, std::size_t& next) {
  if (next == sources.size()) return;
  element.SetUserData(&sources[next++]);
  for (auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    NameSources(*child, sources, next);
  }
}

base::Status TakeExpanded(xacro::Expansion expanded, XmlFile& file) {
  if (file.document->Parse(expanded.xml.data(), expanded.xml.size()) != tinyxml2::XML_SUCCESS) {
    return Fail(ErrorCode::kBadModel,
                std::string("the expanded XML is malformed (") +
                    tinyxml2::XMLDocument::ErrorIDToName(file.document->ErrorID()) + ")",
                file.path.string());
  }
  file.root = file.document->RootElement();
  file.sources = std::move(expanded.sources);
  std::size_t next = 0;
  NameSources(*file.root, file.sources, next);
  return {};
}

// Expands xacro. If that fails for a file whose name ends in .xacro, the file is refused. In other
// files, xacro elements may be remains that other programs ignore, so a failure is only a warning.
base::Status Expand(const ResourceFinder& finder, const ReadLimits& limits,
                    const std::map<std::string, std::string>& arguments, base::Problems& problems,
                    XmlFile& file) {
  base::Problems of_expansion;
  auto expanded = xacro::Expand(*file.root, file.path, {finder, limits, arguments}, of_expansion);
  if (expanded) {
    problems.insert(problems.end(), of_expansion.begin(), of_expansion.end());
    return TakeExpanded(*std::move(expanded), file);
  }
  if (file.path.extension() == ".xacro") return Fail(expanded.error());
  problems.push_back({Problem::Severity::kWarning,
                      "the xacro elements of this file are ignored, since they cannot be "
                      "expanded: " +
                          expanded.error().message,
                      expanded.error().where});
  return {};
}

}  // namespace

base::Result<XmlFile> ReadXml(const std::filesystem::path& named, const ResourceFinder& finder,
                              const ReadLimits& limits, base::Problems& problems) {
  const auto [name, arguments] = xacro::SplitArguments(named.string());
  const std::filesystem::path path(name);
  auto text = ReadText(path, limits.xml_bytes);
  if (!text) return Fail(text.error());
  XmlFile file;
  file.path = path;
  file.named = named;
  file.document = std::make_unique<tinyxml2::XMLDocument>();
  if (auto status = ParseXml(*text, path.string(), limits.xml_bytes, *file.document, problems);
      !status) {
    return Fail(status.error());
  }
  file.root = file.document->RootElement();
  if (file.root != nullptr && xacro::NeedsExpansion(*file.root, path)) {
    if (auto status = Expand(finder, limits, arguments, problems, file); !status) {
      return Fail(status.error());
    }
  }
  const std::string root = file.root == nullptr ? "" : file.root->Name();
  if (root == "gazebo") {
    return Fail(ErrorCode::kBadModel,
                "SDFormat versions before 1.3 are not supported; convert the file to 1.4 or newer",
                path.string() + ":1");
  }
  if (root != "sdf" && root != "robot") {
    return Fail(ErrorCode::kBadModel,
                "expected <sdf> or <robot>, found " + (root.empty() ? "nothing" : "<" + root + ">"),
                path.string() + ":1");
  }
  if (Depth(*file.root, limits.xml_depth) > limits.xml_depth) {
    return Fail(ErrorCode::kBadModel,
                "elements are nested deeper than " + std::to_string(limits.xml_depth) + " levels",
                path.string());
  }
  file.dialect = root == "sdf" ? XmlDialect::kSdf : XmlDialect::kUrdf;
  if (file.dialect == XmlDialect::kSdf) {
    if (auto status = CheckVersion(file, problems); !status) return Fail(status.error());
  }
  return file;
}

void ReportUnsupported(const XmlFile& file, base::Problems& problems) {
  AuditElements({file.path, file.root, file.minor_version}, problems);
}

namespace {

// Whether libsdformat loses the lines of this element and of the elements in it: it keeps copies of
// such elements without line numbers.
bool LosesItsLine(const XMLElement& element) {
  const std::string_view name = element.Name();
  if (name == "gsv:slip") return true;
  const tinyxml2::XMLNode* parent = element.Parent();
  return name == "plugin" && parent != nullptr && parent->ToElement() != nullptr &&
         std::string_view(parent->Value()) == "model";
}

}  // namespace

void LineKeepingPrinter::AdvanceTo(int line) {
  for (; line_ < line; ++line_) out_ += '\n';
}

void LineKeepingPrinter::Text(const std::string& text) {
  out_ += text;
  line_ += static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

void LineKeepingPrinter::Escaped(const char* text) {
  for (; *text != '\0'; ++text) {
    switch (*text) {
      case '&':
        out_ += "&amp;";
        break;
      case '<':
        out_ += "&lt;";
        break;
      case '>':
        out_ += "&gt;";
        break;
      case '"':
        out_ += "&quot;";
        break;
      // A newline in a text would shift later lines, so it becomes a space. For SDFormat all blanks
      // are equal.
      case '\n':
      case '\r':
        out_ += ' ';
        break;
      default:
        out_ += *text;
    }
  }
}

void LineKeepingPrinter::Element(const XMLElement& element) {
  AdvanceTo(element.GetLineNum());
  const bool is_outermost = !marks_lines_;
  if (is_outermost) marks_lines_ = LosesItsLine(element);
  out_ += '<';
  out_ += element.Name();
  for (auto* attribute = element.FirstAttribute(); attribute != nullptr;
       attribute = attribute->Next()) {
    out_ += ' ';
    out_ += attribute->Name();
    out_ += "=\"";
    Escaped(attribute->Value());
    out_ += '"';
  }
  if (marks_lines_) {
    out_ += ' ';
    out_ += kLineAttribute;
    out_ += "=\"" + std::to_string(element.GetLineNum()) + '"';
  }
  out_ += '>';
  for (auto* child = element.FirstChild(); child != nullptr; child = child->NextSibling()) {
    if (auto* inner = child->ToElement()) {
      Element(*inner);
    } else if (auto* text = child->ToText()) {
      Escaped(text->Value());
    }
  }
  out_ += "</";
  out_ += element.Name();
  out_ += '>';
  if (is_outermost) marks_lines_ = false;
}

std::string PrintCompact(const XMLElement& element) {
  tinyxml2::XMLPrinter printer(nullptr, true);
  element.Accept(&printer);
  return printer.CStr();
}

}  // namespace gsv::formats
