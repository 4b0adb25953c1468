// Warnings about plugins, and about elements of GSV's own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

namespace gsv::formats {

// Returns sentences about an unsupported <plugin>, or about parameters that look misspelt.
std::vector<std::string> AboutPlugin(const tinyxml2::XMLElement& plugin);

// A sentence about an element such as <gsv:beem> that GSV does not have; empty about all others. In
// a sensor `is_of_plugin`, which may have parameters of its own, only a name that looks misspelt
// gives a sentence.
std::string AboutOurElement(std::string_view name, bool is_of_plugin);

// Whether GSV has this type of sensor, and SDFormat does not.
bool IsOurSensorType(std::string_view type);

}  // namespace gsv::formats
