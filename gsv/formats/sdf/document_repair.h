// Repairs SDFormat documents, guided by the errors of libsdformat.
#pragma once

#include <sdf/Types.hh>

#include "gsv/base/error.h"
#include "gsv/formats/sdf/included_files.h"

namespace gsv::formats {

// Changes the document, or a file that it includes, to remove the causes of libsdformat's errors.
// It leaves out elements that cannot be read and joints between missing links. It drops references
// to missing frames, and changes names that are in use or reserved. Each change gives a warning.
// Returns false if nothing could be repaired. URDF is never changed.
bool RepairAfter(const sdf::Errors& errors, SdfText& document, IncludedFiles& includes,
                 base::Problems& problems);

// If a model was assembled from other models, Gazebo Classic saves it with links named
// "INNER::LINK". libsdformat splits these names, and throws if their poses are relative to
// something outside of INNER. This function writes "INNER.LINK" instead, with a warning. Returns
// false if there is no such name.
bool SeparateNames(SdfText& document, IncludedFiles& includes, base::Problems& problems);

// SDFormat 1.8 and later reserve "::" for references into nested models, and libsdformat rejects a
// file with such a name. SeparateReservedNames() writes "." in these names and in the references to
// them, with a warning. Other references keep their "::". MayHaveReservedNames() is fast, and may
// return true for a file without such names.
bool MayHaveReservedNames(const SdfText& document, const IncludedFiles& includes);
void SeparateReservedNames(SdfText& document, IncludedFiles& includes, base::Problems& problems);

}  // namespace gsv::formats
