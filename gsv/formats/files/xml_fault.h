// Where an XML text is malformed, and what to do about it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gsv::formats {

struct XmlFault {
  int line = 1, column = 1;  // from 1; columns count bytes
  std::string sentence;      // the fault and a remedy: "<model> is not closed. Add </model>."
};

// The first fault in tags, attributes, comments and what else structures the text. Nothing if the
// text has none of these faults; entities and characters are not looked at.
std::optional<XmlFault> FindXmlFault(std::string_view text);

// "FILE:LINE:COLUMN" and the sentence of an error for a text that a parser refused on `line`.
struct XmlErrorText {
  std::string place, message;
};
XmlErrorText DescribeXmlError(std::string_view text, const std::string& file, int line);

}  // namespace gsv::formats
