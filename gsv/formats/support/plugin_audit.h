// Warnings about plugins, and about elements of GSV's own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

namespace gsv::formats {

// Sentences about a <plugin>: it is not supported, or a parameter of a drive looks misspelt.
std::vector<std::string> AboutPlugin(const tinyxml2::XMLElement& plugin);

// A sentence about an element such as <gsv:beem> that looks misspelt; empty about all others.
std::string AboutOurElement(std::string_view name);

}  // namespace gsv::formats
