// What assimp's COLLADA reader takes on trust.
#pragma once

#include <string>

#include "gsv/base/error.h"

namespace gsv::formats {

// Fails, with a sentence, for text that is no well-formed XML, that claims more values than it
// holds (assimp takes memory for as many), whose accessors reach beyond their arrays (assimp reads
// what lies there), or whose lists of indices hold anything but whole
// numbers (assimp would read them for ever).
base::Status CheckCollada(const std::string& text, const std::string& file);

}  // namespace gsv::formats
