// A Node is an element or a text of a xacro file, with its place in the file.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <tinyxml2.h>

#include "gsv/formats/xacro/xacro.h"

namespace gsv::formats::xacro {

// An element or a text of a xacro file.
struct Node {
  bool is_element = true;
  std::string text;                                             // the element's name, or the text
  std::vector<std::pair<std::string, std::string>> attributes;  // names and values
  std::vector<std::shared_ptr<const Node>> children;
  std::shared_ptr<const std::filesystem::path> file;
  int line = 0;  // in `file`
  // A line of the main file: the node's own line if it is in the main file, else the line of the
  // macro call or include that the node comes from.
  int call_line = 0;

  // Returns the attribute's value; null if there is no such attribute.
  const std::string* attribute(const std::string& name) const;
  std::string place() const;  // "file:line"
};

using NodePtr = std::shared_ptr<const Node>;

// Converts an element. Leaves out comments, and texts that consist of blanks.
NodePtr ToNode(const tinyxml2::XMLElement& element,
               const std::shared_ptr<const std::filesystem::path>& file);

// Returns XML in which each element is on the line `call_line` of its node. If the text is already
// beyond this line, the element is on a later line. Also returns the source of each element, in the
// order of the document. If the text becomes longer than `max_bytes`, it ends soon after that.
// Nodes can share children, so even a few nodes can become a very long text.
Expansion ToXml(const Node& node, std::size_t max_bytes);

}  // namespace gsv::formats::xacro
