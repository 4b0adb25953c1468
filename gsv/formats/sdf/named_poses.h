// Reads the <frame> elements of a world as named poses.
#pragma once

#include <vector>

#include <tinyxml2.h>

#include "gsv/formats/sdf/named_pose.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// Returns the poses of the <frame> elements of a <world>, in the order of the file. `world` is its
// description: frames may be relative to its models. A frame whose pose is malformed, or that is
// relative to anything else, is left out.
std::vector<NamedPose> NamedPosesIn(const tinyxml2::XMLElement& element,
                                    const model::WorldDescription& world);

}  // namespace gsv::formats
