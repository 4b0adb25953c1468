// Python's operators on values, and its functions that descriptions of robots use.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/xacro/value.h"

namespace gsv::formats::xacro {

// + - * / // % **
base::Result<Value> Apply(const std::string& sign, const Value& a, const Value& b);
base::Result<Value> Negative(const Value& value);
// == != < <= > >= in, not in
base::Result<bool> Compare(const std::string& word, const Value& a, const Value& b);
base::Result<Value> Index(const Value& of, const Value& index);
base::Result<Value> Slice(const Value& of, const Value& from, const Value& to);
// of.name: an entry of a dictionary, or a member of a namespace.
base::Result<Value> Member(const Value& of, const std::string& name);

// pi, e, tau, inf, nan.
std::optional<Value> Constant(const std::string& name);
// A function by its name: those of Python's math, those of sequences.h, and abs, min, max, round,
// sum, len, int, float, str, bool, list, tuple.
bool IsFunction(const std::string& name);
base::Result<Value> CallFunction(const std::string& name, const std::vector<Value>& arguments);
// A method of a text, list or dictionary: lower, upper, capitalize, strip, startswith, endswith,
// replace, split, join, find, isdigit, zfill, format, get, keys, values, items.
base::Result<Value> CallMethod(const Value& of, const std::string& name,
                               const std::vector<Value>& arguments);

}  // namespace gsv::formats::xacro
