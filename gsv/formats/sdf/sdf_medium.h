// Reads the media in which bodies move: <wind>, and the fluid of Gazebo's Buoyancy plugin.
#pragma once

#include <tinyxml2.h>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// Reads <wind>, its WindEffects plugin and the Buoyancy plugin of a <world>. Invalid parts give
// warnings.
void ReadMedium(const tinyxml2::XMLElement& world, const ReadingContext& context,
                model::WorldDescription& description);

}  // namespace gsv::formats
