// Which elements of SDFormat and URDF there are, and which of them GSV carries out: one row each.
//
// tools/make_support_page reads these tables, too, and makes docs/formats/sdf-support.md of them.
//
// Element tables
//   [box_shape]                        a definition: the elements and attributes below its element
//   size + 1.4- =1 1 1 ; why           a row: path, sign, versions, default, note
//   Path      element names, joined by "/"; "@name" is an attribute; "*" at the end: may be
//             repeated; ":model" at the end: what is below it is the definition [model].
//   Sign      "+" carried out, "~" in part, "-" not, "." without effect on a simulation.
//   Versions  the first of 1.4 to 1.12 that has it, and the last where a later one dropped it.
//             URDF has none.
//   Default   text that says the same as no element at all.
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
