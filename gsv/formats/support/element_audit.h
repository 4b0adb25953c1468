// Compares a file's XML with the table of elements: what is not carried out is reported.
//
// libsdformat drops what it does not know, and flattens or keeps to itself much of what it does,
// without a word. So the XML itself is compared with the table, before libsdformat sees it.
//
// Reported, as warnings with "file:line: world/model[box]/link[l]/…":
//   - elements and attributes that SDFormat or URDF does not have, or not there, or no more;
//   - a second element where one may stand, a model beside a world, a second shape;
//   - what GSV does not carry out, or in part, unless it says what holds without it;
//   - plugins whose work nobody does.
// Not reported: what is in a namespace of others (<gz:name>), the content of plugins, and what has
// no effect on a simulation.
#pragma once

#include <filesystem>

#include <tinyxml2.h>

#include "gsv/base/error.h"

namespace gsv::formats {

struct AuditedFile {
  std::filesystem::path path;
  const tinyxml2::XMLElement* root;  // <sdf> or <robot>
  int minor_version = 0;             // 9 of SDFormat 1.9; 0 of URDF
};

// Adds one warning for each place, at most kMostFindings of a file and one that counts the rest.
void AuditElements(const AuditedFile& file, base::Problems& problems);

inline constexpr int kMostFindings = 1000;

}  // namespace gsv::formats
