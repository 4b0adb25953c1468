// A Value is a value of a xacro expression. Its types are the types of Python that robot
// descriptions use.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace gsv::formats::xacro {

struct Value;
using List = std::vector<Value>;
using Dictionary = std::vector<std::pair<Value, Value>>;  // in the order of insertion

// The namespace of an included file, for `name.member`.
class Names {
 public:
  virtual ~Names() = default;
  // Returns the value of a name; nullopt if there is none.
  virtual std::optional<Value> Member(const std::string& name) const = 0;
};

// A tuple of Python: a list that cannot be changed.
struct Tuple {
  std::shared_ptr<const List> items;
};

// A value of a xacro expression.
struct Value {
  using Content = std::variant<std::monostate, bool, std::int64_t, double, std::string,
                               std::shared_ptr<const List>, Tuple,
                               std::shared_ptr<const Dictionary>, const Names*>;
  Content content;  // monostate is None

  // The value as type T; null if it has another type.
  template <typename T>
  const T* as() const {
    return std::get_if<T>(&content);
  }
  // Returns the elements of a list or tuple, else null.
  const List* items() const;
  // The entries of a dictionary; null if the value is not a dictionary.
  const Dictionary* dictionary() const;
  bool is_number() const;  // Whether the value is a bool, an int or a float.
};

Value MakeList(List items);
Value MakeTuple(List items);
Value MakeDictionary(Dictionary entries);

// Returns "int", "str", … for messages.
const char* TypeName(const Value& value);

// Converts like Python's str(). Floats get the shortest text that restores the same number.
std::string ToText(const Value& value);
// Converts a float like Python's str().
std::string FloatText(double value);

// Returns the truth value like Python's bool().
bool IsTrue(const Value& value);
// Compares like Python's ==. Two numbers are equal if their values are, even if one is an int and
// the other a float. Other values of different types are never equal.
bool AreEqual(const Value& a, const Value& b);

// Converts a property's or a parameter's text to a number or truth value if possible: "2" is 2,
// "2.0" a float, "true" a bool. Removes single quotes around a text. A text with "_" stays a text.
Value FromLiteral(const std::string& text);

// These functions convert a text like Python's int() and float(). They return nullopt where Python
// raises an exception.
std::optional<std::int64_t> ParseInteger(const std::string& text);
std::optional<double> ParseFloat(const std::string& text);

// Returns the truth value of a condition for <xacro:if>; nullopt if it is neither true nor false.
std::optional<bool> ConditionOf(const Value& value);

}  // namespace gsv::formats::xacro
