// URDF text, ready for libsdformat.
#pragma once

#include <string>

#include "gsv/formats/sdf/sdf_xml.h"

namespace gsv::formats {

// The file's text, repaired as urdf_repair.h has it.
std::string UrdfText(const XmlFile& file, base::Problems& problems);

}  // namespace gsv::formats
