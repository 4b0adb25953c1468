// Text of an XML file, rewritten so that a parser that knows neither entities nor encodings reads
// it.
#pragma once

#include <string>

#include "gsv/base/error.h"

namespace tinyxml2 {
class XMLDocument;
}

namespace gsv::formats {

// Rewrites the text and keeps each line where it is:
//   - the entities that its <!DOCTYPE> declares are expanded (XML 1.0, section 4.4), and the
//     <!DOCTYPE> is removed;
//   - comments and processing instructions are removed, so that a value is one text;
//   - text that is not UTF-8 is read as ISO-8859-1.
// Adds warnings. An entity that is not declared stays as written, and one that another file holds
// is left out. Bytes that are not UTF-8 need a declaration that names ISO-8859-1. <?xml …?> must
// come first.
//
// Errors: kBadModel if an entity contains itself, or if the expanded text has more than `max_bytes`
// bytes. Text with malformed tags is returned as far as it can be read; a parser then finds the
// error.
base::Result<std::string> PrepareXml(const std::string& text, const std::string& file,
                                     std::size_t max_bytes, base::Problems& problems);

// Parses text of `file` after PrepareXml(). Adds a warning for a second root element, which is
// ignored. kBadModel, with line and column, if the XML is malformed.
base::Status ParseXml(const std::string& text, const std::string& file, std::size_t max_bytes,
                      tinyxml2::XMLDocument& document, base::Problems& problems);

}  // namespace gsv::formats
