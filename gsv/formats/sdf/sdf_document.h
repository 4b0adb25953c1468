// libsdformat behind one wall: its console silenced, its errors turned into problems.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include <sdf/Root.hh>

#include "gsv/base/error.h"

namespace gsv::formats {

// A document as libsdformat sees it, and the file it stands for.
struct SdfDocument {
  std::unique_ptr<sdf::Root> root;
  std::filesystem::path source;
};

// Parses SDFormat or URDF text. `includes` maps each <uri> of an <include> to the file to read.
// libsdformat has global state: calls wait for each other.
base::Result<SdfDocument> ParseSdf(const std::string& text, const std::filesystem::path& source,
                                   const std::map<std::string, std::filesystem::path>& includes,
                                   base::Problems& problems);

// The file in which an element stands, and "file:line: element path" for messages about it.
std::filesystem::path FileOf(const sdf::Element& element, const std::filesystem::path& source);
std::string PlaceOf(const sdf::Element& element, const std::filesystem::path& source);

}  // namespace gsv::formats
