// Reads joints that follow others: <mimic> of URDF, and of SDFormat since 1.11.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <tinyxml2.h>

#include "gsv/base/error.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Returns the model with the <mimic> elements of its <robot> or <model>, which libsdformat 12
// drops. A <mimic> that names no existing joint, or the joint itself, is left out with a warning.
std::shared_ptr<const model::Model> WithMimics(const tinyxml2::XMLElement& element,
                                               const std::filesystem::path& file,
                                               std::shared_ptr<const model::Model> model,
                                               base::Problems& problems);

}  // namespace gsv::formats
