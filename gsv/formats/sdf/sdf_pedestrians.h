// Reads `<gsv:pedestrians>` of a world: people who walk in it (docs/people.md).
#pragma once

#include <tinyxml2.h>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/pedestrian_group.h"

namespace gsv::formats {

// Reads a group. Returns null and adds a problem if it is invalid.
std::shared_ptr<const model::PedestrianGroup> ReadPedestrians(const tinyxml2::XMLElement& element,
                                                              const ReadingContext& context);

}  // namespace gsv::formats
