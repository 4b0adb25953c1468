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
//   numbers          the readable part at the beginning is used, otherwise the default
//   <pose>           if it has fewer than six numbers, only the position is used, without rotation
//                    (as in Gazebo Classic)
//   colours          if a component exceeds 2, all components above 1 are divided by 255 (as in
//                    Gazebo Classic). Otherwise components above 1 become 1
//   flags            the default, unless they are true, false, 1 or 0
//   attributes       missing names are made up, other attributes get their default
//   joints           without a parent or child are left out; joints of unknown type become fixed
//   sensors          without a type are left out
void RepairValues(tinyxml2::XMLElement& element, const std::filesystem::path& file,
                  base::Problems& problems);

}  // namespace gsv::formats
