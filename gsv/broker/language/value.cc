#include "gsv/broker/language/value.h"

#include <array>

#include "gsv/base/check.h"

namespace gsv::broker {
namespace {

// The bytes of the TypeCode of a simple type, a length, and alignment.
constexpr std::size_t kValueOverhead = 24;

std::size_t ContentSize(const ScalarValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? text->size() + 8 : 8;
}

}  // namespace

std::string_view Spelling(Scalar scalar) {
  static constexpr std::array<std::string_view, 9> kSpellings = {
      "boolean", "short",  "unsigned short", "long",  "unsigned long",
      "float",   "double", "char",           "string"};
  const auto index = static_cast<std::size_t>(scalar);
  GSV_CHECK(index < kSpellings.size());
  return kSpellings[index];
}

std::string PropertyType::Spelling() const {
  if (scalar == Scalar::kOther) return name;
  const std::string element(broker::Spelling(scalar));
  return sequence ? "sequence<" + element + ">" : element;
}

Value Value::Of(Scalar scalar, ScalarValue content) {
  return std::visit(
      [scalar](auto&& value) { return Value(scalar, std::forward<decltype(value)>(value)); },
      std::move(content));
}

Value Value::SequenceOf(Scalar element, Sequence elements) {
  return Value(element, std::make_shared<const Sequence>(std::move(elements)));
}

Value Value::Strings(const std::vector<std::string>& elements) {
  return SequenceOf(Scalar::kString, Sequence(elements.begin(), elements.end()));
}

Value Value::Other(OtherValue value) {
  return Value(Scalar::kOther, std::make_shared<const OtherValue>(std::move(value)));
}

const Value::Sequence* Value::AsSequence() const {
  const auto* sequence = std::get_if<SequencePtr>(&content_);
  return sequence != nullptr ? sequence->get() : nullptr;
}

const OtherValue* Value::AsOther() const {
  const auto* other = std::get_if<OtherPtr>(&content_);
  return other != nullptr ? other->get() : nullptr;
}

bool Value::Is(const PropertyType& type) const {
  if (scalar_ != type.scalar) return false;
  if (const OtherValue* other = AsOther()) return other->type_name == type.name;
  return is_sequence() == type.sequence;
}

PropertyType Value::Type() const {
  PropertyType type;
  type.scalar = scalar_;
  type.sequence = is_sequence();
  if (const OtherValue* other = AsOther()) type.name = other->type_name;
  return type;
}

std::size_t Value::EncodedSize() const {
  std::size_t size = kValueOverhead;
  if (const Sequence* sequence = AsSequence()) {
    for (const ScalarValue& element : *sequence) size += ContentSize(element);
  } else if (const OtherValue* other = AsOther()) {
    size += other->encoded.size();
  } else if (const auto* text = As<std::string>()) {
    size += text->size();
  }
  return size;
}

bool operator==(const Value& a, const Value& b) {
  if (a.scalar_ != b.scalar_ || a.content_.index() != b.content_.index()) return false;
  if (const auto* sequence = a.AsSequence()) return *sequence == *b.AsSequence();
  if (const auto* other = a.AsOther()) {
    return other->type_name == b.AsOther()->type_name && other->encoded == b.AsOther()->encoded;
  }
  return a.content_ == b.content_;
}

}  // namespace gsv::broker
