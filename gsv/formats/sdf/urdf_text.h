// Prepares URDF text for libsdformat.
#pragma once

#include <string>

#include "gsv/formats/sdf/sdf_xml.h"

namespace gsv::formats {

// Returns the file's text after the repairs of urdf_repair.h.
std::string UrdfText(const XmlFile& file, base::Problems& problems);

}  // namespace gsv::formats
