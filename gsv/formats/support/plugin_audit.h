// Makes warnings about plugins, and about GSV's own elements.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

namespace gsv::formats {

// Returns sentences about an unsupported <plugin>, or about parameters that look misspelt.
std::vector<std::string> AboutPlugin(const tinyxml2::XMLElement& plugin);

// Returns a sentence about an element that GSV does not have, such as <gsv:beem>; empty for other
// elements. `is_of_plugin`: the element is in a sensor whose type a plug-in may define, with its
// own parameters. Then only a name that looks misspelt gives a sentence.
std::string AboutOurElement(std::string_view name, bool is_of_plugin);

// Whether GSV has this type of sensor, and SDFormat does not.
bool IsOurSensorType(std::string_view type);

}  // namespace gsv::formats
