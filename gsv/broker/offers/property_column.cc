#include "gsv/broker/offers/property_column.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "gsv/broker/offers/dynamic_values.h"

namespace gsv::broker {
namespace {

constexpr std::size_t kColumns = 16;
// The maximum length of a text that is copied to the column, bytes.
constexpr std::size_t kShortText = 64;

// The 64-bit content of a sequence's cell: the upper half is the index of the sequence's first
// element, and the lower half is the number of its elements.
constexpr int kHalf = 32;
constexpr std::uint64_t kLowerHalf = 0xFFFFFFFF;

}  // namespace

class PropertyColumn::Builder {
 public:
  explicit Builder(PropertyColumn& column) : column_(column) {}

  void Add(const Value* value) {
    if (value == nullptr) return AddCell(CellKind::kNone, 0);
    if (const auto* sequence = value->AsSequence()) return AddSequence(*sequence);
    if (IsDynamic(*value)) return AddOffer();
    const auto [kind, bits] = CellOf(broker::ToOperand(*value));
    AddCell(kind == CellKind::kNone ? CellKind::kOther : kind, bits);
  }
  void AddOffer() { AddCell(CellKind::kOffer, 0); }

  // Copies the short texts, so that a scan reads contiguous memory.
  void Finish() {
    std::vector<std::string_view>& texts = column_.texts_;
    std::size_t size = 0;
    for (const std::string_view text : texts) size += text.size() <= kShortText ? text.size() : 0;
    column_.short_texts_.reserve(size);
    for (std::string_view& text : texts) {
      if (text.size() > kShortText) continue;
      const std::size_t start = column_.short_texts_.size();
      column_.short_texts_ += text;
      text = std::string_view(column_.short_texts_).substr(start);
    }
  }

 private:
  struct Cell {
    CellKind kind;
    std::uint64_t bits;
  };

  Cell CellOf(const Operand& operand) {
    if (const auto* truth = std::get_if<bool>(&operand)) {
      return {CellKind::kBoolean, static_cast<std::uint64_t>(*truth)};
    }
    if (const auto* integer = std::get_if<std::int64_t>(&operand)) {
      return {CellKind::kInteger, static_cast<std::uint64_t>(*integer)};
    }
    if (const auto* real = std::get_if<double>(&operand)) {
      return {CellKind::kReal, std::bit_cast<std::uint64_t>(*real)};
    }
    if (const auto* text = std::get_if<std::string_view>(&operand)) {
      const auto [known, is_new] = indices_.try_emplace(*text, column_.texts_.size());
      if (is_new) column_.texts_.push_back(*text);
      return {CellKind::kText, known->second};
    }
    return {CellKind::kNone, 0};
  }

  void AddCell(CellKind kind, std::uint64_t bits) {
    column_.kinds_.push_back(kind);
    column_.bits_.push_back(bits);
    column_.present_ |= BitOf(kind);
  }

  void AddSequence(const Value::Sequence& sequence) {
    const std::uint64_t first = column_.element_kinds_.size();
    if (first > kLowerHalf || sequence.size() > kLowerHalf) return AddOffer();
    for (const ScalarValue& element : sequence) {
      const auto [kind, bits] = CellOf(broker::ToOperand(element));
      column_.element_kinds_.push_back(kind);
      column_.element_bits_.push_back(bits);
    }
    AddCell(CellKind::kSequence, first << kHalf | sequence.size());
  }

  PropertyColumn& column_;
  std::unordered_map<std::string_view, std::size_t> indices_;
};

PropertyColumn::PropertyColumn(const Offers& offers, std::string_view property) {
  kinds_.reserve(offers.size());
  bits_.reserve(offers.size());
  Builder builder(*this);
  for (const OfferPtr& offer : offers) {
    if (offer->proxy != nullptr) {
      builder.AddOffer();
    } else {
      builder.Add(offer->properties.Find(property));
    }
  }
  builder.Finish();
}

std::optional<CellKind> PropertyColumn::sole_kind() const {
  const unsigned values = present_ & ~(BitOf(CellKind::kNone) | BitOf(CellKind::kOffer));
  if (values == 0) return CellKind::kNone;
  if (!std::has_single_bit(values)) return std::nullopt;
  return static_cast<CellKind>(std::countr_zero(values));
}

Operand PropertyColumn::ToOperand(CellKind kind, std::uint64_t bits) const {
  switch (kind) {
    case CellKind::kBoolean:
      return bits != 0;
    case CellKind::kInteger:
      return static_cast<std::int64_t>(bits);
    case CellKind::kReal:
      return std::bit_cast<double>(bits);
    case CellKind::kText:
      return texts_[bits];
    default:
      return kNoOperand;
  }
}

Operand PropertyColumn::ContainsAt(std::size_t index, const Operand& element,
                                   std::optional<std::size_t> element_text) const {
  if (kinds_[index] != CellKind::kSequence) return kNoOperand;
  const std::size_t first = bits_[index] >> kHalf;
  const std::size_t end = first + (bits_[index] & kLowerHalf);
  for (std::size_t i = first; i < end; ++i) {
    if (element_text && element_kinds_[i] == CellKind::kText) {
      if (element_bits_[i] == *element_text) return true;
      continue;
    }
    const Operand equal =
        Compare(Operator::kEqual, element, ToOperand(element_kinds_[i], element_bits_[i]));
    if (!std::holds_alternative<bool>(equal)) return kNoOperand;
    if (std::get<bool>(equal)) return true;
  }
  return false;
}

std::size_t PropertyColumn::IndexOf(std::string_view text) const {
  return static_cast<std::size_t>(std::find(texts_.begin(), texts_.end(), text) - texts_.begin());
}

std::shared_ptr<const PropertyColumn> PropertyColumns::Of(const Offers& offers,
                                                          const std::string& property) {
  const base::MutexLock lock(mutex_);
  const auto found = columns_.find(property);
  if (found == columns_.end()) {
    if (columns_.size() < kColumns) columns_.emplace(property, nullptr);
    return nullptr;
  }
  if (found->second == nullptr) {
    found->second = std::make_shared<const PropertyColumn>(offers, property);
  }
  return found->second;
}

bool PropertyColumns::ArePlain(const Offers& offers) {
  const base::MutexLock lock(mutex_);
  if (!plain_) {
    plain_ = std::none_of(offers.begin(), offers.end(), [](const OfferPtr& offer) {
      return offer->proxy != nullptr || HasDynamicProperties(*offer);
    });
  }
  return *plain_;
}

void PropertyColumns::Clear() {
  const base::MutexLock lock(mutex_);
  columns_.clear();
  plain_.reset();
}

}  // namespace gsv::broker
