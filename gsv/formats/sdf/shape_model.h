// Makes models that have one shape and need no file. The name describes the model:
//
//   shape:box?size=0.4,0.4,0.4&mass=8&colour=ff8800
//   shape:wall?size=4,0.1,2           a static box
//   shape:cylinder?radius=0.2&length=1
//   shape:sphere?radius=0.3&static=true
//
// Units    metres, kilograms; the colour is sRGB in six hexadecimal digits.
// Options  mass (default: 1), static (default: false, and true for a wall), colour (default:
//          b4b4b4).
// Bounded  lengths 1e-3 to 1000 m, masses 1e-6 to 1e6 kg, names 256 characters.
#pragma once

#include <string>
#include <string_view>

#include "gsv/base/error.h"

namespace gsv::formats {

bool IsShapeName(std::string_view name);

// Returns an SDFormat document with the model: one link with the shape as its visual and collision,
// and the inertia of a solid of uniform density.
base::Result<std::string> SdfOfShape(const std::string& name);

}  // namespace gsv::formats
