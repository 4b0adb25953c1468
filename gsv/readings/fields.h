// Converts the struct of a reading to values and labels, and back.
//
// Readings of all types are passed as lists of numbers (`values`) and of texts (`labels`). The
// struct of a type (catalogue.h) has a tuple kFields. It lists the members, with name and unit, in
// the order of their numbers and texts in a reading:
//
//   struct Altimeter {
//     double position = 0, velocity = 0, reference = 0;
//     static constexpr auto kFields = std::make_tuple(Value("position", "m", &Altimeter::position),
//                                                     …);
//   };
//
// Decode() and Append() convert the members in the order of kFields, and LayoutOf() describes
// kFields. The Python module makes one attribute for each member in kFields. These are the types of
// members, and what a reading contains for each of them:
//   numbers, flags              one value each
//   std::string                 one label
//   a struct with kFields       its parts, in order
//   std::optional of a struct   its parts; no values if it is empty (for the last member only)
//   std::vector of a struct     its parts again and again, to the end of the values
//   std::span of double         all values that are left; of std::string: all labels that are left
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/readings/layout.h"

namespace gsv::readings {

template <typename Struct, typename Member>
struct Field {
  const char* name;  // the name of the member
  const char* unit;  // such as "m" or "rad/s"; empty if it has none, or if its parts have units
  Member Struct::*member;
  // The field's path in the sensor type's message. Null means that the path equals `name`. An empty
  // path means that the parts have their own paths.
  const char* path;
  bool is_optional;  // whether a reading may end before this field
};

template <typename Struct, typename Member>
constexpr Field<Struct, Member> Value(const char* name, const char* unit, Member Struct::*member,
                                      const char* path = nullptr) {
  return {name, unit, member, path, false};
}

template <typename Struct, typename Member>
constexpr Field<Struct, Member> OptionalValue(const char* name, const char* unit,
                                              Member Struct::*member, const char* path = nullptr) {
  return {name, unit, member, path, true};
}

// Calls `function` with each Field of the struct.
template <typename Struct, typename Function>
constexpr void ForEachField(Function function) {
  std::apply([&](const auto&... field) { (function(field), ...); }, Struct::kFields);
}

namespace internal {

// The kinds of members, from the list at the top of this file.
template <typename T>
inline constexpr bool kIsOptional = false;
template <typename T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <typename T>
inline constexpr bool kIsList = false;
template <typename T>
inline constexpr bool kIsList<std::vector<T>> = true;
template <typename T>
inline constexpr bool kIsLabel = std::is_same_v<T, std::string>;
template <typename T>
inline constexpr bool kIsAllValues = std::is_same_v<T, std::span<const double>>;
template <typename T>
inline constexpr bool kIsAllLabels = std::is_same_v<T, std::span<const std::string>>;

// Decodes values from the start to the end of a reading.
class Cursor {
 public:
  Cursor(std::span<const double> values, std::span<const std::string> labels)
      : values_(values), labels_(labels) {}

  bool has_values() const { return !values_.empty(); }
  // Whether all values were present, and none is left.
  bool is_exact() const { return !is_bad_ && values_.empty() && labels_.empty(); }

  // Reads the next value; 0 if there is none.
  double Value() {
    if (values_.empty()) return is_bad_ = true, 0;
    const double value = values_.front();
    values_ = values_.subspan(1);
    return value;
  }
  // Reads the next value and converts it to the type; 0 if the type cannot hold it.
  template <typename Whole>
  Whole WholeValue() {
    const double value = Value();
    const bool fits = value >= 0 && value < 0x1p53 &&
                      value <= static_cast<double>(std::numeric_limits<Whole>::max());
    if (!fits) is_bad_ = true;
    return fits ? static_cast<Whole>(value) : Whole{};
  }
  // Reads the next label; empty if there is none.
  std::string Label() {
    if (labels_.empty()) return is_bad_ = true, std::string();
    const std::string& label = labels_.front();
    labels_ = labels_.subspan(1);
    return label;
  }
  // Reads all remaining values.
  std::span<const double> AllValues() { return std::exchange(values_, {}); }
  // Reads all remaining labels.
  std::span<const std::string> AllLabels() { return std::exchange(labels_, {}); }

 private:
  std::span<const double> values_;
  std::span<const std::string> labels_;
  bool is_bad_ = false;  // whether a value or label was missing or invalid
};

template <typename Struct>
void Read(Cursor& from, Struct& to);

template <typename Member>
void ReadMember(Cursor& from, Member& to) {
  if constexpr (std::is_same_v<Member, bool>) {
    to = from.Value() != 0;
  } else if constexpr (std::is_integral_v<Member>) {
    to = from.WholeValue<Member>();
  } else if constexpr (std::is_floating_point_v<Member>) {
    to = from.Value();
  } else if constexpr (kIsLabel<Member>) {
    to = from.Label();
  } else if constexpr (kIsAllValues<Member>) {
    to = from.AllValues();
  } else if constexpr (kIsAllLabels<Member>) {
    to = from.AllLabels();
  } else if constexpr (kIsOptional<Member>) {
    if (from.has_values()) Read(from, to.emplace());
  } else if constexpr (kIsList<Member>) {
    while (from.has_values()) Read(from, to.emplace_back());
  } else {
    Read(from, to);
  }
}

template <typename Struct>
void Read(Cursor& from, Struct& to) {
  ForEachField<Struct>([&](const auto& field) {
    if (!field.is_optional || from.has_values()) ReadMember(from, to.*field.member);
  });
}

template <typename Member, typename Values>
void AppendMember(const Member& from, Values& values, std::vector<std::string>& labels) {
  const auto append_fields = [&](const auto& part) {
    using Part = std::remove_cvref_t<decltype(part)>;
    ForEachField<Part>(
        [&](const auto& field) { AppendMember(part.*field.member, values, labels); });
  };
  if constexpr (std::is_arithmetic_v<Member>) {
    values.push_back(static_cast<double>(from));
  } else if constexpr (kIsLabel<Member>) {
    labels.push_back(from);
  } else if constexpr (kIsAllValues<Member>) {
    values.insert(values.end(), from.begin(), from.end());
  } else if constexpr (kIsAllLabels<Member>) {
    labels.insert(labels.end(), from.begin(), from.end());
  } else if constexpr (kIsOptional<Member>) {
    if (from) append_fields(*from);
  } else if constexpr (kIsList<Member>) {
    for (const auto& part : from) append_fields(part);
  } else {
    append_fields(from);
  }
}

template <typename Struct>
constexpr bool HasLabels();

template <typename Member>
constexpr bool HasLabelsIn() {
  if constexpr (kIsLabel<Member> || kIsAllLabels<Member>) {
    return true;
  } else if constexpr (kIsList<Member> || kIsOptional<Member>) {
    return HasLabels<typename Member::value_type>();
  } else if constexpr (std::is_arithmetic_v<Member> || kIsAllValues<Member>) {
    return false;
  } else {
    return HasLabels<Member>();
  }
}

template <typename Struct>
constexpr bool HasLabels() {
  bool has = false;
  ForEachField<Struct>([&]<typename Of, typename Member>(const Field<Of, Member>&) {
    has = has || HasLabelsIn<Member>();
  });
  return has;
}

template <typename Struct>
void Describe(const Place& place, Layout& layout) {
  ForEachField<Struct>([&]<typename Of, typename Member>(const Field<Of, Member>& field) {
    Place inner = place.Inside(field.name, field.unit, field.path);
    if (field.is_optional || kIsOptional<Member>) inner.occurs = Multiplicity::kOptional;
    if constexpr (kIsList<Member> || kIsAllValues<Member> || kIsAllLabels<Member>) {
      inner.occurs = Multiplicity::kRepeated;
    }
    if constexpr (kIsLabel<Member> || kIsAllLabels<Member>) {
      layout.AddLabel(inner);
    } else if constexpr (std::is_arithmetic_v<Member> || kIsAllValues<Member>) {
      layout.AddValue(inner);
    } else if constexpr (kIsList<Member> || kIsOptional<Member>) {
      Describe<typename Member::value_type>(inner, layout);
    } else {
      Describe<Member>(inner, layout);
    }
  });
}

}  // namespace internal

// Whether readings of this layout have labels.
template <typename Struct>
inline constexpr bool kHasLabels = internal::HasLabels<Struct>();

template <typename Struct>
Layout LayoutOf() {
  Layout layout;
  internal::Describe<Struct>({}, layout);
  return layout;
}

// Appends the struct's numbers to `values` and its names to `labels`.
template <typename Struct, typename Values>
void Append(const Struct& from, Values& values, std::vector<std::string>& labels) {
  internal::AppendMember(from, values, labels);
}

// Decodes a reading into its struct. Spans in the struct refer to the reading. Fails with kCorrupt
// and the place `where` if the reading does not have the size of the layout.
template <typename Struct>
base::Result<Struct> Decode(std::span<const double> values, std::span<const std::string> labels,
                            const std::string& where) {
  internal::Cursor cursor(values, labels);
  base::Result<Struct> decoded;
  internal::Read(cursor, *decoded);
  bool is_whole = cursor.is_exact();
  if constexpr (requires { decoded->IsComplete(); }) is_whole = is_whole && decoded->IsComplete();
  if (is_whole) return decoded;
  return base::Fail(WrongSize(LayoutOf<Struct>(), values.size(), labels.size(), where));
}

}  // namespace gsv::readings
