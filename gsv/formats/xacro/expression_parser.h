// Parses xacro's expressions, which have the syntax of Python. Only the part of Python that robot
// descriptions use is supported.
//
// Grammar  ternary (a if b else c), or, and, not, comparisons (chained, in, not in, is), + - * / //
//          % **, unary signs, calls, members, indices and slices, lists, tuples, dictionaries,
//          strings, numbers, True, False, None.
// Refused  with an error: lambda, comprehensions, assignments, f-strings, bit operators.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/xacro/value.h"

namespace gsv::formats::xacro {

// A node of an expression's syntax tree. The comments at the kinds list the members that they use.
struct Expression {
  enum class Kind {
    kLiteral,  // value
    kName,     // text
    kMember,   // parts[0] . text
    kIndex,    // parts[0] [ parts[1] ]
    kSlice,    // parts[0] [ parts[1] : parts[2] ]; a missing end is null
    // parts[0]: function; other parts: arguments; words: names of the keyword arguments, which come
    // last
    kCall,
    kList,
    kTuple,
    kDictionary,  // key, value, key, value, …
    kUnary,       // text: "-", "+" or "not"
    kBinary,      // text: the operator
    kCompare,     // parts: operands; words: the operators between them
    kAnd,
    kOr,
    kTernary,  // parts: condition, then, else
  };
  Kind kind = Kind::kLiteral;
  std::string text;
  Value value;
  std::vector<std::unique_ptr<Expression>> parts;
  std::vector<std::string> words;
};

// Fails with kBadModel and the reason. The caller adds the place.
base::Result<std::unique_ptr<Expression>> ParseExpression(const std::string& text);

}  // namespace gsv::formats::xacro
