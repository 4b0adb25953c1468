// Reads the <frame> elements of a world as named poses.
#pragma once

#include <vector>

#include <tinyxml2.h>

#include "gsv/formats/sdf/named_pose.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// Returns the poses of the <frame> elements of a <world>, in the order of the file. `world` is the
// description of this world: frames may be relative to the world's models. A frame whose pose is
// malformed, or that is relative to anything else, is left out.
std::vector<NamedPose> NamedPosesIn(const tinyxml2::XMLElement& element,
                                    const model::WorldDescription& world);

}  // namespace gsv::formats
