// Reads the general entities that a <!DOCTYPE> declares.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace gsv::formats {

// An entity that a <!DOCTYPE> declares: a name for a text.
struct XmlEntity {
  std::string value;         // text of the entity, which may refer to other entities
  bool is_external = false;  // whether its text is in another file (SYSTEM, PUBLIC)
};

// The content of a <!DOCTYPE>: its general entities, by name.
struct XmlDoctype {
  std::map<std::string, XmlEntity, std::less<>> entities;
  bool has_parameters =
      false;            // whether it declares or uses parameter entities, which are not expanded
  std::size_t end = 0;  // index of the character after its ">"; npos if it does not end
};

// Reads the "<!DOCTYPE" that begins at index `begin` of `text`. If an entity is declared several
// times, the first declaration counts.
XmlDoctype ReadDoctype(std::string_view text, std::size_t begin);

// Whether `&name;` is one of the five entities of XML itself, or a character reference.
bool IsPredefinedEntity(std::string_view name);

// Returns the length of NAME if `text` begins with "&NAME;"; 0 if it does not.
std::size_t EntityNameLength(std::string_view text);

}  // namespace gsv::formats
