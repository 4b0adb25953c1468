#include "gsv/broker/offers/number_column.h"

#include <algorithm>
#include <functional>
#include <limits>

#include "gsv/broker/offers/dynamic_values.h"

namespace gsv::broker {
namespace {

constexpr std::size_t kColumns = 8;

template <typename Comparison>
void NarrowBy(const Comparison& holds, const std::vector<double>& numbers,
              const std::vector<Choice>& known, double literal, std::vector<Choice>& choices) {
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const Choice term =
        known[i] == Choice::kYes && !holds(numbers[i], literal) ? Choice::kNo : known[i];
    choices[i] =
        term == Choice::kNo || choices[i] == Choice::kNo ? Choice::kNo : std::max(term, choices[i]);
  }
}

}  // namespace

std::optional<double> ExactNumber(std::int64_t integer) {
  constexpr std::int64_t kMaxExactInteger = std::int64_t{1} << 53;
  if (integer < -kMaxExactInteger || integer > kMaxExactInteger) return std::nullopt;
  return static_cast<double>(integer);
}

NumberColumn::NumberColumn(const Offers& offers, const std::string& property)
    : numbers_(offers.size()), known_(offers.size(), Choice::kNo) {
  for (std::size_t i = 0; i < offers.size(); ++i) {
    if (offers[i]->proxy != nullptr) {
      known_[i] = Choice::kUnknown;
      continue;
    }
    const Value* value = offers[i]->properties.Find(property);
    if (value == nullptr) continue;
    if (const auto* real = value->As<double>()) {
      numbers_[i] = *real;
      known_[i] = Choice::kYes;
    } else if (const auto* integer = value->As<std::int64_t>()) {
      const auto exact = ExactNumber(*integer);
      numbers_[i] = exact.value_or(0);
      known_[i] = exact ? Choice::kYes : Choice::kUnknown;
    } else if (IsDynamic(*value)) {
      known_[i] = Choice::kUnknown;
    }
  }
}

std::optional<double> NumberColumn::At(std::size_t index) const {
  switch (known_[index]) {
    case Choice::kYes:
      return numbers_[index];
    case Choice::kNo:
      return std::numeric_limits<double>::quiet_NaN();
    case Choice::kUnknown:
      break;
  }
  return std::nullopt;
}

void NumberColumn::Narrow(const NumberTerm& term, std::vector<Choice>& choices) const {
  const auto by = [&](const auto& holds) {
    NarrowBy(holds, numbers_, known_, term.number, choices);
  };
  switch (term.op) {
    case Operator::kEqual:
      return by(std::equal_to<>());
    case Operator::kNotEqual:
      return by(std::not_equal_to<>());
    case Operator::kLess:
      return by(std::less<>());
    case Operator::kLessEqual:
      return by(std::less_equal<>());
    case Operator::kGreater:
      return by(std::greater<>());
    default:
      return by(std::greater_equal<>());
  }
}

std::shared_ptr<const NumberColumn> NumberColumns::Of(const Offers& offers,
                                                      const std::string& property) {
  const base::MutexLock lock(mutex_);
  const auto found = columns_.find(property);
  if (found == columns_.end()) {
    if (columns_.size() < kColumns) columns_.emplace(property, nullptr);
    return nullptr;
  }
  if (found->second == nullptr) {
    found->second = std::make_shared<const NumberColumn>(offers, property);
  }
  return found->second;
}

}  // namespace gsv::broker
