// URDF text, ready for libsdformat.
#pragma once

#include <string>

#include "gsv/formats/sdf/sdf_xml.h"

namespace gsv::formats {

// The file's text, repaired as urdf_repair.h has it, with what xacro would fill in: `${NAME}` and `$(arg NAME)` of properties and
// arguments that have a literal value. Files that need more of xacro (macros, includes, conditions,
// arithmetic) are refused with a sentence that says to run xacro first.
base::Result<std::string> UrdfText(const XmlFile& file, base::Problems& problems);

}  // namespace gsv::formats
