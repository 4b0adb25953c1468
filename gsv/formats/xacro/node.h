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
  int line = 0;       // in `file`
  int call_line = 0;  // line in the main file: of the node itself, or of the call or include

  // Returns the attribute's value; null if there is no such attribute.
  const std::string* attribute(const std::string& name) const;
  std::string place() const;  // "file:line"
};

using NodePtr = std::shared_ptr<const Node>;

// Converts an element. Leaves out comments, and texts that consist of blanks.
NodePtr ToNode(const tinyxml2::XMLElement& element,
               const std::shared_ptr<const std::filesystem::path>& file);

// Returns XML in which each element is on its node's call line, or on a later line because lines
// cannot decrease. Also returns the source of each element, in the order of the document. Stops
// soon after `max_bytes`, because nodes can share children, so that a few nodes can become a very
// long text.
Expansion ToXml(const Node& node, std::size_t max_bytes);

}  // namespace gsv::formats::xacro
