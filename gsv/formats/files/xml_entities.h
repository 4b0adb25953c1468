// The general entities that a <!DOCTYPE> declares.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace gsv::formats {

struct XmlEntity {
  std::string value;         // its text, which may refer to other entities
  bool is_external = false;  // declared with SYSTEM or PUBLIC: another file holds the text
};

struct XmlDoctype {
  std::map<std::string, XmlEntity, std::less<>> entities;
  bool has_parameters =
      false;            // whether it declares or uses parameter entities, which are not expanded
  std::size_t end = 0;  // the index after its ">"; npos if it does not end
};

// Reads the declaration that begins at `begin` of `text` with "<!DOCTYPE". The first declaration of
// a name counts.
XmlDoctype ReadDoctype(std::string_view text, std::size_t begin);

// Whether `&name;` is one of the five entities of XML itself, or a character reference.
bool IsPredefinedEntity(std::string_view name);

// The length of the entity's name, if `text` begins with "&NAME;"; 0 if it does not.
std::size_t EntityNameLength(std::string_view text);

}  // namespace gsv::formats
