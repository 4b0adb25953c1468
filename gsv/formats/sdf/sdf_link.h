// From libsdformat's Link to ours.
#pragma once

#include <sdf/Link.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// The name and the pose are the caller's. A visual whose mesh is absent is replaced by the link's
// collision shapes in grey, once; a collision whose mesh is absent is left out. `is_static`: its
// inertia is of no use, so that nothing in it is wrong.
model::Link ReadLink(const sdf::Link& source, bool is_static, const ReadingContext& context);

// A pose resolved by libsdformat in the frame of its parent element, or in `resolve_to`. One that
// cannot be resolved is a warning, and taken as written; one that is not finite is the identity.
geometry::Pose Resolve(const sdf::SemanticPose& pose, const std::string& resolve_to,
                       const std::string& place, const ReadingContext& context);

}  // namespace gsv::formats
