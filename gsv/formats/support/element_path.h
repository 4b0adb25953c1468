// Finds the places of XML elements, for messages.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <tinyxml2.h>

namespace gsv::formats {

// The origin of an element. An element from the expansion of a xacro file may come from a macro or
// an included file. The user data (XMLNode::GetUserData) of such an element points to its
// ElementSource. Nothing else sets the user data of elements.
struct ElementSource {
  std::shared_ptr<const std::filesystem::path> file;
  int line = 0;
};

// Returns "file:line" of an element: the place in its ElementSource, or else its line in `file`.
std::string PlaceOf(const std::filesystem::path& file, const tinyxml2::XMLNode& node);

// Returns a path such as "world/model[box]/link[l]". Names distinguish siblings.
std::string PathOf(const tinyxml2::XMLElement& element);

}  // namespace gsv::formats
