// Where an element stands, for messages.
#pragma once

#include <string>

#include <tinyxml2.h>

namespace gsv::formats {

// "world/model[box]/link[l]": names distinguish what stands beside each other.
std::string PathOf(const tinyxml2::XMLElement& element);

}  // namespace gsv::formats
