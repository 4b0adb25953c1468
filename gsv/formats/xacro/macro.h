// The definition of a macro, and the parameters that it takes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gsv/formats/xacro/node.h"

namespace gsv::formats::xacro {

struct Parameter {
  enum class Kind {
    kValue,
    kBlock,     // *name: the parameter is an element
    kChildren,  // **name: the parameter is the content of an element
  };
  std::string name;  // without asterisks
  Kind kind = Kind::kValue;
  bool is_forwarded = false;  // ^: the default is the caller's property
  std::optional<std::string> otherwise;
};

// Parses "a b:=1 c:=^|'x y' *block". Blanks outside of quotes and ${…} separate parameters.
std::vector<Parameter> ParseParameters(const std::string& text);

struct Macro {
  NodePtr definition;
  std::vector<Parameter> parameters;
};

}  // namespace gsv::formats::xacro
