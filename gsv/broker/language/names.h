// Checks the names in offers and service types.
//
// Source  OMG Trading Object Service (formal/00-06-27), annex B. Letters are the letters of ISO
//         Latin-1.
#pragma once

#include <string_view>

namespace gsv::broker {

inline bool IsLetter(unsigned char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= 0xC0 && c != 0xD7 && c != 0xF7);
}

inline bool IsDigit(unsigned char c) { return c >= '0' && c <= '9'; }

// Whether the name is a letter followed by letters, digits and '_'. Properties, policies and links
// have such names.
bool IsIdentifier(std::string_view name);

// Whether the name is a scoped name ("::Finance::Converter") or a repository identifier
// ("IDL:omg.org/X:1.0").
bool IsServiceTypeName(std::string_view name);

// Whether the name is a keyword of the constraint language. Properties must not have such names.
bool IsReservedWord(std::string_view name);

}  // namespace gsv::broker
