// Repairs documents by what libsdformat says is wrong with them.
#pragma once

#include <sdf/Types.hh>

#include "gsv/base/error.h"
#include "gsv/formats/sdf/included_files.h"

namespace gsv::formats {

// Changes the document, or a file that it includes, so that libsdformat's errors go away. It leaves
// out elements that cannot be read and joints between missing links. It drops references to missing
// frames, and changes names that are taken or reserved. Each change is a warning. False when there was nothing that it could repair; URDF is never changed.
bool RepairAfter(const sdf::Errors& errors, SdfText& document, IncludedFiles& includes,
                 base::Problems& problems);

// Gazebo Classic saves a model that was put together from others with links named "INNER::LINK".
// libsdformat takes these apart, and throws where their poses are relative to something outside.
// Writes "INNER.LINK" instead, with a warning. False when there is no such name.
bool SeparateNames(SdfText& document, IncludedFiles& includes, base::Problems& problems);

}  // namespace gsv::formats
