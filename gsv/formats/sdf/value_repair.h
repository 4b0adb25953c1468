// Repairs the values in an SDFormat file before libsdformat reads it, because libsdformat refuses
// the whole file if a single number is malformed.
#pragma once

#include <filesystem>

#include <tinyxml2.h>

#include "gsv/base/error.h"

namespace gsv::formats {

// Compares `element` (a <world>, <model>, <light>, <actor>, <sensor> or <sdf>) and all below it
// with libsdformat's description of SDFormat 1.9, and changes values that libsdformat would refuse.
// Each change gives a warning:
//   numbers          the readable part is used, otherwise the default
//   <pose>           of fewer than six numbers: the position, without rotation (as Gazebo Classic)
//   colours          components above 1 are taken as parts of 255 (as Gazebo Classic), or as 1
//   flags            the default, unless they are true, false, 1 or 0
//   attributes       missing names are made up, other attributes get their default
//   joints           without a parent or child are left out; joints of unknown type become fixed
//   sensors          without a type are left out
void RepairValues(tinyxml2::XMLElement& element, const std::filesystem::path& file,
                  base::Problems& problems);

}  // namespace gsv::formats
