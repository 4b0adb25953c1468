// Reads and prepares the XML of a model or world file, before libsdformat reads it.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <tinyxml2.h>

#include "gsv/base/error.h"
#include "gsv/formats/files/read_limits.h"
#include "gsv/formats/files/resource_finder.h"
#include "gsv/formats/support/element_path.h"

namespace gsv::formats {

// The format of an XML file: SDFormat or URDF.
enum class XmlDialect { kSdf, kUrdf };

// The XML of a model or world file, ready for libsdformat.
struct XmlFile {
  std::filesystem::path path;
  std::filesystem::path named;  // the name as given to ReadXml(), with the arguments for xacro
  std::vector<ElementSource> sources;  // origins of the elements of a xacro file; else empty
  std::unique_ptr<tinyxml2::XMLDocument> document;
  tinyxml2::XMLElement* root = nullptr;  // <sdf> or <robot>
  XmlDialect dialect = XmlDialect::kSdf;
  std::string version;    // version of <sdf>, at most 1.9
  int minor_version = 0;  // 11 for an <sdf> of version 1.11; 0 for <robot>
};

// Reads a file and checks its size, its XML, its root and version. A version newer than 1.9 is read
// as 1.9: ReportUnsupported() names the elements that are lost. A xacro file is expanded
// (xacro/xacro.h); its path may have arguments (xacro/arguments.h).
base::Result<XmlFile> ReadXml(const std::filesystem::path& path, const ResourceFinder& finder,
                              const ReadLimits& limits, base::Problems& problems);

// Adds a warning for each element and attribute that is unknown or unsupported, see
// gsv/formats/support/element_audit.h. Call it before the file's elements are changed.
void ReportUnsupported(const XmlFile& file, base::Problems& problems);

// The attribute with the line of an element in its file. libsdformat does not store the lines of
// the elements in a <plugin>, and of elements that it does not know.
inline constexpr char kLineAttribute[] = "gsv:line";

// Prints elements so that each is on the same line as in its file. Then libsdformat's errors have
// the right lines. Elements must come in the order of their lines.
class LineKeepingPrinter {
 public:
  void Text(const std::string& text);  // markup, unchanged
  void Escaped(const char* text);      // prints a text or an attribute's value on one line
  // Prints an element with its content.
  void Element(const tinyxml2::XMLElement& element);
  // Returns the printed text. The printer is empty afterwards.
  std::string Take() { return std::move(out_); }

 private:
  // Prints newlines up to the line.
  void AdvanceTo(int line);

  std::string out_;           // the text that was printed so far
  int line_ = 1;              // number of the line that is being printed
  bool marks_lines_ = false;  // whether to print kLineAttribute
};

// Returns an element as text without line breaks. Equal elements give equal texts.
std::string PrintCompact(const tinyxml2::XMLElement& element);

}  // namespace gsv::formats
