// `<gsv:pedestrians>` of a world: people who walk about in it (docs/people.md).
#pragma once

#include <tinyxml2.h>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/pedestrian_group.h"

namespace gsv::formats {

// Null, with a problem, for a group that makes no sense.
std::shared_ptr<const model::PedestrianGroup> ReadPedestrians(const tinyxml2::XMLElement& element,
                                                              const ReadingContext& context);

}  // namespace gsv::formats
