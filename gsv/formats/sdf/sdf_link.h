// Converts links from libsdformat.
#pragma once

#include <sdf/Link.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Reads a link; the caller sets its name and pose. If the meshes of some visuals are missing, the
// link's collision shapes in grey replace all these visuals together. A collision whose mesh is
// missing is left out. If `is_static` is true, the inertia is not used, and so not checked.
model::Link ReadLink(const sdf::Link& source, bool is_static, const ReadingContext& context);

// Returns a pose that libsdformat resolves in the frame of the element's parent, or in
// `resolve_to`. A pose that cannot be resolved gives a warning, and is used as written. A pose that
// is not finite becomes the identity.
geometry::Pose Resolve(const sdf::SemanticPose& pose, const std::string& resolve_to,
                       const std::string& place, const ReadingContext& context);

}  // namespace gsv::formats
