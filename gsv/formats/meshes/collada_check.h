// Checks COLLADA text for errors that assimp's reader does not check.
#pragma once

#include <string>

#include "gsv/base/error.h"

namespace gsv::formats {

// Fails if the text is not well-formed XML. Fails if an array declares more values
// than it has (assimp allocates the declared number), or if an accessor reaches beyond its array
// (assimp reads there). Fails if a list of indices has anything but whole numbers (assimp would not
// terminate).
base::Status CheckCollada(const std::string& text, const std::string& file);

}  // namespace gsv::formats
