// A name for what a model looks like: equal looks, equal names, on every machine and in every run.
#pragma once

#include <string>

#include "gsv/model/model.h"

namespace gsv::presentation {

// Sixteen hexadecimal digits: a hash of all that goes into a model's GLB.
std::string ModelIdentity(const model::Model& model);

}  // namespace gsv::presentation
