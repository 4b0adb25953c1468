#include "gsv/broker/language/value.h"

#include <array>
#include <atomic>
#include <cstring>
#include <limits>
#include <new>

#include "gsv/base/check.h"

namespace gsv::broker {
namespace {

// Upper bound of the encoded bytes besides the content: the TypeCode of a simple type, a length,
// and padding.
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

template <typename Content>
struct Value::Shared {
  std::atomic<std::uint32_t> owners = 1;
  Content content;
};

// The head of a shared text. The characters follow it in the same block of memory.
struct Value::LongText {
  std::atomic<std::uint32_t> owners = 1;
  std::uint32_t size;

  const char* text() const { return reinterpret_cast<const char*>(this + 1); }
};

template <typename T>
T Value::Read() const {
  static_assert(sizeof(T) <= kInlineText);
  T content;
  std::memcpy(&content, content_.data(), sizeof content);
  return content;
}

template <typename T>
void Value::Write(Form form, const T& content) {
  static_assert(sizeof(T) <= kInlineText);
  form_ = form;
  std::memcpy(content_.data(), &content, sizeof content);
}

Value::Value(Scalar scalar, bool value) : scalar_(scalar) { Write(Form::kBoolean, value); }
Value::Value(Scalar scalar, std::int64_t value) : scalar_(scalar) { Write(Form::kInteger, value); }
Value::Value(Scalar scalar, double value) : scalar_(scalar) { Write(Form::kReal, value); }

Value::Value(Scalar scalar, std::string_view text) : scalar_(scalar) {
  if (text.size() <= kInlineText) {
    form_ = static_cast<Form>(text.size());
    std::copy(text.begin(), text.end(), content_.begin());
    return;
  }
  GSV_CHECK(text.size() <= std::numeric_limits<std::uint32_t>::max());
  void* block = ::operator new(sizeof(LongText) + text.size());
  auto* head = new (block) LongText{.size = static_cast<std::uint32_t>(text.size())};
  text.copy(static_cast<char*>(block) + sizeof(LongText), text.size());
  Write(Form::kLongText, head);
}

Value::Value(const Value& other)
    : content_(other.content_), form_(other.form_), scalar_(other.scalar_) {
  WithShared([](auto* shared) { shared->owners.fetch_add(1, std::memory_order_relaxed); });
}

Value::Value(Value&& other) noexcept
    : content_(other.content_), form_(other.form_), scalar_(other.scalar_) {
  other.Write(Form::kBoolean, false);
}

Value& Value::operator=(Value other) noexcept {
  std::swap(content_, other.content_);
  std::swap(form_, other.form_);
  std::swap(scalar_, other.scalar_);
  return *this;
}

template <typename Use>
void Value::WithShared(const Use& use) const {
  switch (form_) {
    case Form::kLongText:
      return use(Read<LongText*>());
    case Form::kSequence:
      return use(Read<Shared<Sequence>*>());
    case Form::kOther:
      return use(Read<Shared<OtherValue>*>());
    default:
      return;
  }
}

void Value::Release() {
  WithShared([](auto* shared) {
    if (shared->owners.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
    if constexpr (std::is_same_v<decltype(shared), LongText*>) {
      shared->~LongText();
      ::operator delete(shared);
    } else {
      delete shared;
    }
  });
}

Value Value::Of(Scalar scalar, const ScalarValue& content) {
  return std::visit([scalar](const auto& value) { return Value(scalar, value); }, content);
}

Value Value::SequenceOf(Scalar element, Sequence elements) {
  Value value(element, false);
  value.Write(Form::kSequence, new Shared<Sequence>{.content = std::move(elements)});
  return value;
}

Value Value::Strings(const std::vector<std::string>& elements) {
  return SequenceOf(Scalar::kString, Sequence(elements.begin(), elements.end()));
}

Value Value::Other(OtherValue other) {
  Value value(Scalar::kOther, false);
  value.Write(Form::kOther, new Shared<OtherValue>{.content = std::move(other)});
  return value;
}

std::optional<bool> Value::AsBoolean() const {
  return form_ == Form::kBoolean ? std::optional(Read<bool>()) : std::nullopt;
}

std::optional<std::int64_t> Value::AsInteger() const {
  return form_ == Form::kInteger ? std::optional(Read<std::int64_t>()) : std::nullopt;
}

std::optional<double> Value::AsReal() const {
  return form_ == Form::kReal ? std::optional(Read<double>()) : std::nullopt;
}

std::optional<std::string_view> Value::AsText() const {
  const auto length = static_cast<std::size_t>(form_);
  if (length <= kInlineText) return std::string_view(content_.data(), length);
  if (form_ != Form::kLongText) return std::nullopt;
  const auto* head = Read<const LongText*>();
  return std::string_view(head->text(), head->size);
}

const Value::Sequence* Value::AsSequence() const {
  return form_ == Form::kSequence ? &Read<const Shared<Sequence>*>()->content : nullptr;
}

const OtherValue* Value::AsOther() const {
  return form_ == Form::kOther ? &Read<const Shared<OtherValue>*>()->content : nullptr;
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
  } else if (const auto text = AsText()) {
    size += text->size();
  }
  return size;
}

bool operator==(const Value& a, const Value& b) {
  if (a.scalar_ != b.scalar_) return false;
  if (const auto* sequence = a.AsSequence()) {
    return b.is_sequence() && *sequence == *b.AsSequence();
  }
  if (const auto* other = a.AsOther()) {
    const auto* second = b.AsOther();
    return second != nullptr && other->type_name == second->type_name &&
           other->encoded == second->encoded;
  }
  return !b.is_sequence() && b.AsOther() == nullptr && a.AsBoolean() == b.AsBoolean() &&
         a.AsInteger() == b.AsInteger() && a.AsReal() == b.AsReal() && a.AsText() == b.AsText();
}

}  // namespace gsv::broker
