// The value of an offer's property, and its type. Values that the constraint language can handle
// are plain data. All others stay encoded.
//
// Source  OMG Trading Object Service (formal/00-06-27), annex B, "basic elements": boolean, short,
//         unsigned short, long, unsigned long, float, double, char, string, and sequences of these.
//         A property of any other type may only be used with `exist`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
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

// An int64 represents integers of every width, a double both float types, and a string also a char.
using ScalarValue = std::variant<bool, std::int64_t, double, std::string>;

// The type of a property. Two types are equal if `scalar`, `sequence` and `name` are equal.
struct PropertyType {
  Scalar scalar = Scalar::kOther;  // the type, or the type of a sequence's elements
  bool sequence = false;           // whether the type is a sequence
  std::string name{};  // for a kOther type, its IDL spelling with aliases resolved; else empty
  // the TypeCode as a CDR encapsulation, for a kOther type and for an alias; else empty
  std::string encoded{};

  // Returns a text such as "unsigned long", "sequence<string>" or "struct IDL:acme/Place:1.0".
  std::string Spelling() const;

  friend bool operator==(const PropertyType& a, const PropertyType& b) {
    return a.scalar == b.scalar && a.sequence == b.sequence && a.name == b.name;
  }
};

// A value of a type that the constraint language cannot handle: the spelling of its type, and the
// whole `any` as a CDR encapsulation.
struct OtherValue {
  std::string type_name;  // spelling of the value's type
  std::string encoded;    // the `any` as a CDR encapsulation
  // For a dynamic property, `encoded` refers to the service that computes the value, and this is
  // the declared type of the computed value. Null if the property is not dynamic.
  std::shared_ptr<const PropertyType> promised_type{};
};

// An immutable value of 16 bytes that is cheap to copy. Numbers and texts of at most 14 bytes are
// stored in the object itself. Longer content is shared between copies.
class Value {
 public:
  using Sequence = std::vector<ScalarValue>;

  // These functions make a value of the IDL type of this name.
  static Value Boolean(bool value) { return Value(Scalar::kBoolean, value); }
  static Value Short(std::int16_t value) { return Integer(Scalar::kShort, value); }
  static Value UShort(std::uint16_t value) { return Integer(Scalar::kUShort, value); }
  static Value Long(std::int32_t value) { return Integer(Scalar::kLong, value); }
  static Value ULong(std::uint32_t value) { return Integer(Scalar::kULong, value); }
  static Value Float(float value) { return Value(Scalar::kFloat, static_cast<double>(value)); }
  static Value Double(double value) { return Value(Scalar::kDouble, value); }
  static Value Char(char value) { return Value(Scalar::kChar, std::string_view(&value, 1)); }
  static Value String(std::string_view value) { return Value(Scalar::kString, value); }
  // `content` and `elements` have the alternative that belongs to their scalar, see ScalarValue.
  static Value Of(Scalar scalar, const ScalarValue& content);
  // Makes a sequence whose elements have this type.
  static Value SequenceOf(Scalar element, Sequence elements);
  // Makes a sequence of strings.
  static Value Strings(const std::vector<std::string>& elements);
  // Makes a value of a type that the constraint language does not know.
  static Value Other(OtherValue value);

  Value(const Value& other);
  Value(Value&& other) noexcept;
  Value& operator=(Value other) noexcept;
  ~Value() { Release(); }

  // The type of the value, or of the elements of a sequence.
  Scalar scalar() const { return scalar_; }
  bool is_sequence() const { return form_ == Form::kSequence; }

  // Each function returns nullopt or null if the value is of another kind. A returned view is valid
  // as long as this object.
  std::optional<bool> AsBoolean() const;
  std::optional<std::int64_t> AsInteger() const;
  std::optional<double> AsReal() const;
  std::optional<std::string_view> AsText() const;
  const Sequence* AsSequence() const;
  const OtherValue* AsOther() const;

  // Whether a property declared as `type` may hold this value.
  bool Is(const PropertyType& type) const;
  // Returns the type of the value.
  PropertyType Type() const;

  // An upper bound of the encoded size of the value, in bytes.
  std::size_t EncodedSize() const;

  friend bool operator==(const Value& a, const Value& b);

 private:
  // Maximum length of a text that is stored in the object itself, in bytes.
  static constexpr std::size_t kInlineText = 14;

  // The kind of data in `content_`. Values up to kInlineText mean a text of that length.
  enum class Form : std::uint8_t {
    kBoolean = kInlineText + 1,
    kInteger,
    kReal,
    kLongText,  // for this form and the next two, `content_` is a pointer to shared content
    kSequence,
    kOther,
  };
  template <typename Content>
  // The content of a sequence or other value, and the number of Values that share it.
  struct Shared;
  // A text that is too long for content_, and the number of Values that share it.
  struct LongText;

  Value(Scalar scalar, bool value);
  Value(Scalar scalar, std::int64_t value);
  Value(Scalar scalar, double value);
  Value(Scalar scalar, std::string_view text);
  static Value Integer(Scalar scalar, std::int64_t value) { return Value(scalar, value); }

  template <typename T>
  // Returns the first bytes of content_ as a T.
  T Read() const;
  template <typename T>
  // Sets form_, and the first bytes of content_.
  void Write(Form form, const T& content);
  // Calls `use` with the shared content, if there is any.
  template <typename Use>
  void WithShared(const Use& use) const;
  // Gives up this object's share of the shared content, and deletes the content after its last
  // user.
  void Release();

  alignas(8) std::array<char, kInlineText> content_{};  // the value itself, or a pointer to it
  Form form_ = Form::kBoolean;
  Scalar scalar_;
};
static_assert(sizeof(Value) == 16);

// Returns, for example, "unsigned long" for kULong. Not for kOther.
std::string_view Spelling(Scalar scalar);

}  // namespace gsv::broker
