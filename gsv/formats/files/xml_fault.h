// Finds the place where XML is malformed, and suggests a remedy.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gsv::formats {

// The first error in malformed XML, and its place.
struct XmlFault {
  int line = 1, column = 1;  // counted from 1; columns count bytes
  std::string sentence;      // the fault and a remedy: "<model> is not closed. Add </model>."
};

// Returns the first error in tags, attributes, comments and other markup, or nullopt if there is
// none. Entities and characters are not checked.
std::optional<XmlFault> FindXmlFault(std::string_view text);

// The place "FILE:LINE:COLUMN" of an error, and its sentence.
struct XmlErrorText {
  std::string place, message;
};
// Describes the error in a text that a parser refused on `line`.
XmlErrorText DescribeXmlError(std::string_view text, const std::string& file, int line);

}  // namespace gsv::formats
