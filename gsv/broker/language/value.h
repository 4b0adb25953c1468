// The value of an offer's property, and its type. Values that the constraint language can handle
// are plain data. All others stay encoded.
//
// Source  OMG Trading Object Service (formal/00-06-27), annex B, "basic elements": boolean, short,
//         unsigned short, long, unsigned long, float, double, char, string, and sequences of these.
//         A property of any other type may only be used with `exist`.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace gsv::broker {

enum class Scalar : std::uint8_t {
  kBoolean,
  kShort,
  kUShort,
  kLong,
  kULong,
  kFloat,
  kDouble,
  kChar,
  kString,
  kOther,
};

// An int64 holds integers of every width, a double both float types, and a string also a char.
using ScalarValue = std::variant<bool, std::int64_t, double, std::string>;

// The type of a property. Two types are equal when their scalar, sequence and name are.
struct PropertyType {
  Scalar scalar = Scalar::kOther;
  bool sequence = false;
  std::string name{};     // for a kOther type, its IDL spelling with aliases resolved; else empty
  std::string encoded{};  // for a kOther type, its TypeCode as a CDR encapsulation; else empty

  // Returns a text such as "unsigned long", "sequence<string>" or "struct IDL:acme/Place:1.0".
  std::string Spelling() const;

  friend bool operator==(const PropertyType& a, const PropertyType& b) {
    return a.scalar == b.scalar && a.sequence == b.sequence && a.name == b.name;
  }
};

// A value of a type that the constraint language cannot handle: the spelling of its type, and the
// whole `any` as a CDR encapsulation.
struct OtherValue {
  std::string type_name;
  std::string encoded;
  // For a dynamic property the type of its value. Null for all others.
  std::shared_ptr<const PropertyType> promised_type{};
};

// An immutable value that is cheap to copy.
class Value {
 public:
  using Sequence = std::vector<ScalarValue>;

  static Value Boolean(bool value) { return Value(Scalar::kBoolean, value); }
  static Value Short(std::int16_t value) { return Integer(Scalar::kShort, value); }
  static Value UShort(std::uint16_t value) { return Integer(Scalar::kUShort, value); }
  static Value Long(std::int32_t value) { return Integer(Scalar::kLong, value); }
  static Value ULong(std::uint32_t value) { return Integer(Scalar::kULong, value); }
  static Value Float(float value) { return Value(Scalar::kFloat, static_cast<double>(value)); }
  static Value Double(double value) { return Value(Scalar::kDouble, value); }
  static Value Char(char value) { return Value(Scalar::kChar, std::string(1, value)); }
  static Value String(std::string value) { return Value(Scalar::kString, std::move(value)); }
  // `content` and `elements` have the alternative that belongs to their scalar, see ScalarValue.
  static Value Of(Scalar scalar, ScalarValue content);
  static Value SequenceOf(Scalar element, Sequence elements);
  static Value Strings(const std::vector<std::string>& elements);
  static Value Other(OtherValue value);

  // The type of the value, or of the elements of a sequence.
  Scalar scalar() const { return scalar_; }
  bool is_sequence() const { return std::holds_alternative<SequencePtr>(content_); }

  // Returns null if the value is of another kind.
  template <typename T>
  const T* As() const {
    return std::get_if<T>(&content_);
  }
  const Sequence* AsSequence() const;
  const OtherValue* AsOther() const;

  // Whether a property declared as `type` may hold this value.
  bool Is(const PropertyType& type) const;
  PropertyType Type() const;

  // An upper bound of its encoded size, in bytes.
  std::size_t EncodedSize() const;

  friend bool operator==(const Value& a, const Value& b);

 private:
  using SequencePtr = std::shared_ptr<const Sequence>;
  using OtherPtr = std::shared_ptr<const OtherValue>;
  using Content = std::variant<bool, std::int64_t, double, std::string, SequencePtr, OtherPtr>;

  Value(Scalar scalar, Content content) : scalar_(scalar), content_(std::move(content)) {}
  static Value Integer(Scalar scalar, std::int64_t value) { return Value(scalar, value); }

  Scalar scalar_;
  Content content_;
};

// Returns, for example, "unsigned long" for kULong. Not for kOther.
std::string_view Spelling(Scalar scalar);

}  // namespace gsv::broker
