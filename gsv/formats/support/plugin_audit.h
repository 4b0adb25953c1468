// Warnings about plugins, and about elements of GSV's own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

namespace gsv::formats {

// Returns sentences about an unsupported <plugin>, or about parameters that look misspelt.
std::vector<std::string> AboutPlugin(const tinyxml2::XMLElement& plugin);

// Returns a sentence about an element such as <gsv:beem> that looks misspelt; empty for all others.
std::string AboutOurElement(std::string_view name);

}  // namespace gsv::formats
