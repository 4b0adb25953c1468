#include "gsv/formats/xacro/sequences.h"

#include <algorithm>
#include <cstdio>

#include "gsv/base/check.h"
#include "gsv/base/named.h"
#include "gsv/formats/xacro/operators.h"

namespace gsv::formats::xacro {
namespace {

constexpr std::size_t kMaxSequence = 10'000, kMaxSorted = 1000;
constexpr int kMaxDecimals = 30;
constexpr double kMaxFormattedNumber = 1e17;

base::Failure<base::Error> InvalidList(const std::string& why) {
  return base::Fail(base::ErrorCode::kBadModel, why);
}

base::Result<Value> Range(const List& a) {
  std::int64_t from = 0, to = 0, step = 1;
  std::int64_t* const targets[3] = {a.size() == 1 ? &to : &from, &to, &step};
  for (std::size_t i = 0; i < a.size() && i < 3; ++i) {
    const auto* number = a[i].as<std::int64_t>();
    if (number == nullptr) return InvalidList("range() takes integers");
    *targets[i] = *number;
  }
  constexpr std::int64_t kFarthest = std::int64_t{1} << 53;
  const bool is_small = std::max({std::abs(from), std::abs(to), std::abs(step)}) < kFarthest;
  if (a.empty() || a.size() > 3 || step == 0 || !is_small)
    return InvalidList("range() takes integers");
  List items;
  for (std::int64_t i = from; step > 0 ? i < to : i > to; i += step) {
    if (items.size() == kMaxSequence) return InvalidList("a list has more than 10000 values");
    items.push_back({i});
  }
  return MakeList(std::move(items));
}

base::Result<Value> Sorted(const List& a) {
  List items = *a[0].items();
  if (items.size() > kMaxSorted) {
    return InvalidList("sorted() takes at most " + std::to_string(kMaxSorted) + " values");
  }
  // This is an insertion sort, because std::sort does not allow comparisons that fail or contradict
  // each other.
  for (std::size_t i = 1; i < items.size(); ++i) {
    for (std::size_t k = i; k > 0; --k) {
      const auto is_less = Compare("<", items[k], items[k - 1]);
      if (!is_less) return base::Fail(is_less.error());
      if (!*is_less) break;
      std::swap(items[k], items[k - 1]);
    }
  }
  return MakeList(std::move(items));
}

base::Result<Value> Reversed(const List& a) {
  return MakeList(List(a[0].items()->rbegin(), a[0].items()->rend()));
}

base::Result<Value> Enumerated(const List& a) {
  List pairs;
  for (const Value& item : *a[0].items()) {
    pairs.push_back(MakeTuple({Value{static_cast<std::int64_t>(pairs.size())}, item}));
  }
  return MakeList(std::move(pairs));
}

base::Result<Value> Zipped(const List& a) {
  std::size_t shortest = kMaxSequence;
  for (const Value& each : a) shortest = std::min(shortest, each.items()->size());
  List rows;
  for (std::size_t i = 0; i < shortest; ++i) {
    List row;
    for (const Value& each : a) row.push_back((*each.items())[i]);
    rows.push_back(MakeTuple(std::move(row)));
  }
  return MakeList(std::move(rows));
}

base::Result<Value> Any(const List& a) {
  return Value{std::any_of(a[0].items()->begin(), a[0].items()->end(), &IsTrue)};
}

base::Result<Value> All(const List& a) {
  return Value{std::all_of(a[0].items()->begin(), a[0].items()->end(), &IsTrue)};
}

// Functions of lists; each takes one list, except zip().
constexpr base::Named<base::Result<Value> (*)(const List&)> kOfLists[] = {
    {"sorted", &Sorted}, {"reversed", &Reversed}, {"enumerate", &Enumerated},
    {"zip", &Zipped},    {"any", &Any},           {"all", &All}};

// Returns the text of a value for a replacement field of format(), such as ".2f".
base::Result<std::string> FormattedField(const Value& value, const std::string& format) {
  if (format.empty()) return ToText(value);
  int decimals = -1, read = 0;
  const bool is_known = std::sscanf(format.c_str(), ".%2df%n", &decimals, &read) == 1 &&
                        read == static_cast<int>(format.size()) && decimals >= 0 &&
                        decimals <= kMaxDecimals && value.is_number();
  const auto number = is_known ? ParseFloat(ToText(value)) : std::nullopt;
  if (!number || !(*number > -kMaxFormattedNumber && *number < kMaxFormattedNumber)) {
    return base::Fail(base::ErrorCode::kBadModel,
                      "the format \"" + format + "\" is not supported; use \".Nf\"");
  }
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, *number);
  return std::string(text);
}

}  // namespace

bool IsSequenceFunction(const std::string& name) {
  return name == "range" || base::FindNamed(kOfLists, name) != nullptr;
}

base::Result<Value> CallSequenceFunction(const std::string& name, const List& arguments) {
  if (name == "range") return Range(arguments);
  const bool are_lists = !arguments.empty() && (arguments.size() == 1 || name == "zip") &&
                         std::all_of(arguments.begin(), arguments.end(),
                                     [](const Value& each) { return each.items() != nullptr; });
  if (!are_lists) return InvalidList(name + "() takes a list");
  const auto* function = base::FindNamed(kOfLists, name);
  GSV_CHECK(function != nullptr);
  return (*function)(arguments);
}

base::Result<Value> Formatted(const std::string& text, const List& arguments) {
  std::string formatted;
  std::size_t next = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool is_doubled = at + 1 < text.size() && text[at + 1] == text[at];
    if ((text[at] == '{' || text[at] == '}') && is_doubled) {
      formatted += text[at++];
    } else if (text[at] != '{') {
      formatted += text[at];
    } else {
      const std::size_t end = text.find('}', at);
      if (end == std::string::npos) return InvalidList("format() misses \"}\"");
      const std::string field = text.substr(at + 1, end - at - 1);
      const std::size_t colon = std::min(field.find(':'), field.size());
      const auto number = ParseInteger(field.substr(0, colon));
      if (colon > 0 && !number) return InvalidList("format() takes values by position only");
      const std::size_t index = number ? static_cast<std::size_t>(*number) : next++;
      if (index >= arguments.size()) return InvalidList("format() lacks a value");
      const auto value =
          FormattedField(arguments[index], colon < field.size() ? field.substr(colon + 1) : "");
      if (!value) return base::Fail(value.error());
      formatted += *value;
      if (formatted.size() > (1u << 20)) return InvalidList("a string is longer than 1 MiB");
      at = end;
    }
  }
  return Value{formatted};
}

}  // namespace gsv::formats::xacro
