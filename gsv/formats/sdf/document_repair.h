// Repairs documents by what libsdformat says is wrong with them.
#pragma once

#include <sdf/Types.hh>

#include "gsv/base/error.h"
#include "gsv/formats/sdf/included_files.h"

namespace gsv::formats {

// Changes the document, or a file that it includes, so that libsdformat's errors go away: an element
// that cannot be read is left out, a reference to a frame that is not there is dropped, a joint
// between links that are not there is left out, a name that is taken or reserved is changed. Each
// change is a warning. False when there was nothing that it could repair; URDF is never changed.
bool RepairAfter(const sdf::Errors& errors, SdfText& document, IncludedFiles& includes,
                 base::Problems& problems);

// Gazebo Classic saves a model that was put together from others with links named "INNER::LINK".
// libsdformat takes these apart, and throws where their poses are relative to something outside.
// Writes "INNER.LINK" instead, with a warning. False when there is no such name.
bool SeparateNames(SdfText& document, IncludedFiles& includes, base::Problems& problems);

}  // namespace gsv::formats
