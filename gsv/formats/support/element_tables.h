// The elements of SDFormat and URDF, and their support in GSV: one row each.
//
// tools/make_support_page also reads these tables, and makes docs/formats/sdf-support.md from them.
//
// Element tables
//   [box_shape]                        a definition: the elements and attributes below its element
//   size + 1.4- =1 1 1 ; why           a row: path, sign, versions, default, note
//   Path      element names, joined by "/"; "@name" is an attribute; "*" at the end: may be
//             repeated; ":model" at the end: the content is that of the definition [model].
//   Sign      "+" supported, "~" in part, "-" not, "." without effect on a simulation.
//   Versions  the first version (1.4 to 1.12) that has the element, and the last version if a later
//             version dropped the element. URDF has none.
//   Default   text with the same meaning as a missing element.
//   Note      what GSV does instead, as a clause.
//
// Plugin table
//   + diffdrive; a differential drive    sign, part of its file's or class's name, note
//   Names are compared in lower case without "-" and "_".
#pragma once

#include <string_view>

namespace gsv::formats {

extern const std::string_view kWorldElements;
extern const std::string_view kModelElements;
extern const std::string_view kSensorElements;
extern const std::string_view kUrdfElements;
extern const std::string_view kKnownPlugins;

}  // namespace gsv::formats
