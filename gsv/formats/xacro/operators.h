// Implements Python's operators, and the Python functions that robot descriptions use.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/xacro/value.h"

namespace gsv::formats::xacro {

// Applies one of + - * / // % **
base::Result<Value> Apply(const std::string& sign, const Value& a, const Value& b);
// Returns -value.
base::Result<Value> Negative(const Value& value);
// Compares two values. `word` is ==, !=, <, <=, >, >=, "in" or "not in".
base::Result<bool> Compare(const std::string& word, const Value& a, const Value& b);
// Returns of[index].
base::Result<Value> Index(const Value& of, const Value& index);
// Returns of[from:to].
base::Result<Value> Slice(const Value& of, const Value& from, const Value& to);
// Returns of.name: an entry of a dictionary, or a member of a namespace.
base::Result<Value> Member(const Value& of, const std::string& name);

// Returns one of pi, e, tau, inf, nan.
std::optional<Value> Constant(const std::string& name);
// IsFunction() and CallFunction() find and call a function by its name. Supported are the usual
// functions of Python's math, the functions of sequences.h, and abs, min, max, round, sum, len,
// int, float, str, bool, list, tuple.
bool IsFunction(const std::string& name);
// Calls a function by its name.
base::Result<Value> CallFunction(const std::string& name, const std::vector<Value>& arguments);
// Calls a method of a text or dictionary: lower, upper, capitalize, strip, startswith,
// endswith, replace, split, join, find, isdigit, zfill, format, get, keys, values, items.
base::Result<Value> CallMethod(const Value& of, const std::string& name,
                               const std::vector<Value>& arguments);

}  // namespace gsv::formats::xacro
