// Converts links from libsdformat.
#pragma once

#include <sdf/Link.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// The caller sets name and pose. If the mesh of a visual is missing, the link's collision shapes
// replace it, once, in grey. A collision without its mesh is left out. `is_static`: the inertia is
// not used, so that it is not checked.
model::Link ReadLink(const sdf::Link& source, bool is_static, const ReadingContext& context);

// A pose resolved by libsdformat in the frame of its parent element, or in `resolve_to`. A pose
// that cannot be resolved gives a warning, and is used as written. A non-finite pose becomes the
// identity.
geometry::Pose Resolve(const sdf::SemanticPose& pose, const std::string& resolve_to,
                       const std::string& place, const ReadingContext& context);

}  // namespace gsv::formats
