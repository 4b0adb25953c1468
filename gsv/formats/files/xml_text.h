// Rewrites the text of an XML file for a parser that supports neither declared entities nor
// encodings other than UTF-8.
#pragma once

#include <string>

#include "gsv/base/error.h"

namespace tinyxml2 {
class XMLDocument;
}

namespace gsv::formats {

// Rewrites the text without moving any line:
//   - the entities that its <!DOCTYPE> declares are expanded (XML 1.0, section 4.4), and the
//     <!DOCTYPE> is removed;
//   - comments and processing instructions are removed, so that a value is one text;
//   - text that is not UTF-8 is read as ISO-8859-1.
// An entity that is not declared stays as written. An entity whose text is in another file is left
// out. Adds warnings for both kinds of entities, for text before <?xml …?>, and for text that is
// neither UTF-8 nor declared as ISO-8859-1.
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
