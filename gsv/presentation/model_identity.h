// Computes an identifier of a model's appearance. Equal models have equal identifiers on every
// machine and in every run.
#pragma once

#include <string>

#include "gsv/model/model.h"

namespace gsv::presentation {

// Returns sixteen hexadecimal digits: a hash of all data of the model's GLB.
std::string ModelIdentity(const model::Model& model);

}  // namespace gsv::presentation
