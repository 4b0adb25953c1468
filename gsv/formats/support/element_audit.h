// Compares a file's XML with the table of elements, and reports elements that GSV does not support.
//
// libsdformat drops unknown elements, and does not give access to many known elements, without a
// warning. Therefore this checks the XML before libsdformat reads it.
//
// Reported, as warnings with "file:line: world/model[box]/link[l]/…":
//   - elements and attributes that SDFormat or URDF does not define there, or no longer defines;
//   - a second element where only one is allowed, a model beside a world, a second shape;
//   - elements that GSV supports in part or not at all, unless they have the default value;
//   - plugins that GSV does not replace;
//   - parameters of supported plugins that look misspelt.
// Not reported: elements in other namespaces (<gz:name>), all other content of plugins, and
// elements that have no effect on a simulation.
#pragma once

#include <filesystem>

#include <tinyxml2.h>

#include "gsv/base/error.h"

namespace gsv::formats {

// A file whose elements are checked.
struct AuditedFile {
  std::filesystem::path path;
  const tinyxml2::XMLElement* root;  // the element <sdf> or <robot>
  int minor_version = 0;             // 9 for SDFormat 1.9; 0 for URDF
};

// Adds at most kMaxFindings warnings, and one warning with the number of further findings.
void AuditElements(const AuditedFile& file, base::Problems& problems);

inline constexpr int kMaxFindings = 1000;

}  // namespace gsv::formats
