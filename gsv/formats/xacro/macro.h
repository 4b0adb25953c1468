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
    kBlock,     // *name: an element
    kChildren,  // **name: what is in an element
  };
  std::string name;  // without asterisks
  Kind kind = Kind::kValue;
  bool is_forwarded = false;  // ^: the caller's property of that name, if there is one
  std::optional<std::string> otherwise;
};

// "a b:=1 c:=^|'x y' *block": separated by blanks; in quotes and in ${…} blanks do not separate.
std::vector<Parameter> ParseParameters(const std::string& text);

struct Macro {
  NodePtr definition;
  std::vector<Parameter> parameters;
};

}  // namespace gsv::formats::xacro
