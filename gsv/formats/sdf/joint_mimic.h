// Reads joints that follow other joints: <mimic> of URDF, and of SDFormat since 1.11.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <tinyxml2.h>

#include "gsv/base/error.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Adds to the model the <mimic> elements of its <robot> or <model>, because libsdformat 12 drops
// them. A <mimic> that names a missing joint, or the joint itself, is left out with a warning.
std::shared_ptr<const model::Model> WithMimics(const tinyxml2::XMLElement& element,
                                               const std::filesystem::path& file,
                                               std::shared_ptr<const model::Model> model,
                                               base::Problems& problems);

}  // namespace gsv::formats
