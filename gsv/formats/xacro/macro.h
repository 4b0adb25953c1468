// The definition of a xacro macro, with its parameters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gsv/formats/xacro/node.h"

namespace gsv::formats::xacro {

// A parameter in the attribute `params` of <xacro:macro>.
struct Parameter {
  enum class Kind {
    kValue,     // the argument is an attribute
    kBlock,     // *name: the argument is an element
    kChildren,  // **name: the argument is the content of an element
  };
  std::string name;  // without asterisks
  Kind kind = Kind::kValue;
  // ^: the default is the caller's property of this name
  bool is_forwarded = false;
  std::optional<std::string> otherwise;  // the default; nullopt if a value is required
};

// Parses "a b:=1 c:=^|'x y' *block". Blanks outside of quotes and ${…} separate parameters.
std::vector<Parameter> ParseParameters(const std::string& text);

// A macro: its element <xacro:macro>, and its parameters.
struct Macro {
  NodePtr definition;
  std::vector<Parameter> parameters;
};

}  // namespace gsv::formats::xacro
