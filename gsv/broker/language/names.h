// Checks the names in offers and service types.
//
// Source  OMG Trading Object Service (formal/00-06-27), annex B: letters are those of ISO Latin-1.
#pragma once

#include <string_view>

namespace gsv::broker {

inline bool IsLetter(unsigned char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= 0xC0 && c != 0xD7 && c != 0xF7);
}

inline bool IsDigit(unsigned char c) { return c >= '0' && c <= '9'; }

// A letter, then letters, digits and '_': the names of properties, policies and links.
bool IsIdentifier(std::string_view name);

// A scoped name ("::Finance::Converter"), or a repository identifier ("IDL:omg.org/X:1.0").
bool IsServiceTypeName(std::string_view name);

// The keywords of the constraint language; no property may have such a name.
bool IsReservedWord(std::string_view name);

}  // namespace gsv::broker
