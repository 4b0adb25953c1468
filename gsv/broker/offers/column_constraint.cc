#include "gsv/broker/offers/column_constraint.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "gsv/broker/language/operand.h"

namespace gsv::broker {
namespace {

enum Truth : std::uint8_t { kFalse, kTrue, kNoTruth };
using Truths = std::vector<Truth>;

Truth ToTruth(const Operand& operand) {
  const auto* truth = std::get_if<bool>(&operand);
  return truth == nullptr ? kNoTruth : *truth ? kTrue : kFalse;
}

// One operand of an operator, for many offers: one literal for all offers, a column, or computed
// numbers.
struct Operands {
  const ScalarValue* literal = nullptr;
  const PropertyColumn* column = nullptr;
  std::span<const CellKind> kinds{};
  std::span<const std::uint64_t> bits{};
  // The kind of all operands that have a value, or nullopt if their kinds differ.
  std::optional<CellKind> sole_kind{};
  bool has_missing = true;  // false if every operand has a value of the kind `sole_kind`
  std::vector<CellKind> own_kinds{};
  std::vector<std::uint64_t> own_bits{};

  Operand At(std::size_t index) const {
    if (literal != nullptr) return ToOperand(*literal);
    if (column != nullptr) return column->At(index);
    switch (kinds[index]) {
      case CellKind::kBoolean:
        return bits[index] != 0;
      case CellKind::kInteger:
        return static_cast<std::int64_t>(bits[index]);
      case CellKind::kReal:
        return std::bit_cast<double>(bits[index]);
      default:
        return kNoOperand;
    }
  }
};

// OneNumber is the same number for every offer. ManyNumbers has one number per offer.
template <typename T>
struct OneNumber {
  T number;
  T operator[](std::size_t) const { return number; }
};
template <typename T>
struct ManyNumbers {
  std::span<const std::uint64_t> bits;
  T operator[](std::size_t index) const { return std::bit_cast<T>(bits[index]); }
};

// Calls `use` with the numbers of type T (std::int64_t or double). Returns false if an operand is
// not of type T. A literal of the other type is converted if its magnitude is at most 2^53 and T
// can represent it exactly.
template <typename T, typename Use>
bool WithNumbers(const Operands& operands, const Use& use) {
  constexpr bool kReals = std::is_same_v<T, double>;
  constexpr double kMaxExact = 9007199254740992.0;  // 2^53
  if (operands.literal == nullptr) {
    if (operands.sole_kind != (kReals ? CellKind::kReal : CellKind::kInteger)) return false;
    use(ManyNumbers<T>{operands.bits});
    return true;
  }
  if (const auto* number = std::get_if<T>(operands.literal)) {
    use(OneNumber<T>{*number});
    return true;
  }
  using Other = std::conditional_t<kReals, std::int64_t, double>;
  const auto* other = std::get_if<Other>(operands.literal);
  if (other == nullptr || !(std::abs(static_cast<double>(*other)) <= kMaxExact)) return false;
  if (static_cast<Other>(static_cast<T>(*other)) != *other) return false;
  use(OneNumber<T>{static_cast<T>(*other)});
  return true;
}

template <typename T, typename Use>
bool WithNumbers(const Operands& left, const Operands& right, const Use& use) {
  if (left.literal != nullptr && right.literal != nullptr) return false;
  bool used = false;
  WithNumbers<T>(left, [&](const auto& a) {
    used = WithNumbers<T>(right, [&](const auto& b) { use(a, b); });
  });
  return used;
}

class Evaluation {
 public:
  Evaluation(const Expression& constraint, const std::vector<std::size_t>& column_of_node,
             const ColumnConstraint::Columns& columns, std::size_t offers)
      : nodes_(constraint.nodes),
        column_of_node_(column_of_node),
        columns_(columns),
        offers_(offers) {}

  Truths TruthsOf(std::size_t index) const {
    const Node& node = nodes_[index];
    switch (node.op) {
      case Operator::kExist:
        return Exist(ColumnOf(index));
      case Operator::kNot:
        return Negate(TruthsOf(node.left));
      case Operator::kOr:
        return Decide(node, kTrue);
      case Operator::kAnd:
        return Decide(node, kFalse);
      case Operator::kIn:
        return In(OperandsOf(node.left), ColumnOf(index));
      case Operator::kSubstring:
        return Substrings(OperandsOf(node.left), OperandsOf(node.right));
      case Operator::kLiteral:
      case Operator::kProperty:
      case Operator::kAdd:
      case Operator::kSubtract:
      case Operator::kMultiply:
      case Operator::kDivide: {
        const Operands operands = OperandsOf(index);
        return ForEach([&](std::size_t i) { return operands.At(i); });
      }
      default:
        return Comparisons(node.op, OperandsOf(node.left), OperandsOf(node.right));
    }
  }

 private:
  const PropertyColumn& ColumnOf(std::size_t index) const {
    return *columns_[column_of_node_[index]];
  }

  Operands OperandsOf(std::size_t index) const {
    const Node& node = nodes_[index];
    switch (node.op) {
      case Operator::kLiteral:
        return {.literal = &node.literal};
      case Operator::kProperty: {
        const PropertyColumn& column = ColumnOf(index);
        return {.column = &column,
                .kinds = column.kinds(),
                .bits = column.bits(),
                .sole_kind = column.sole_kind(),
                .has_missing = column.Has(CellKind::kNone) || column.Has(CellKind::kOffer)};
      }
      case Operator::kAdd:
      case Operator::kSubtract:
      case Operator::kMultiply:
      case Operator::kDivide:
        return Results(node.op, OperandsOf(node.left), OperandsOf(node.right));
      default:
        return ToOperands(TruthsOf(index));
    }
  }

  template <typename Compute>
  Truths ForEach(const Compute& compute) const {
    Truths truths(offers_);
    for (std::size_t i = 0; i < offers_; ++i) truths[i] = ToTruth(compute(i));
    return truths;
  }

  Truths Exist(const PropertyColumn& column) const {
    Truths truths(offers_);
    std::transform(column.kinds().begin(), column.kinds().end(), truths.begin(),
                   [](CellKind kind) { return kind == CellKind::kNone ? kFalse : kTrue; });
    return truths;
  }

  static Truths Negate(Truths truths) {
    constexpr std::array<Truth, 3> kNegated = {kTrue, kFalse, kNoTruth};
    for (Truth& truth : truths) truth = kNegated[truth];
    return truths;
  }

  // Evaluates `and` or `or`. If an offer's left operand is `deciding` or has no value, the left
  // operand is the result. Otherwise the right operand is the result.
  Truths Decide(const Node& node, Truth deciding) const {
    Truths left = TruthsOf(node.left);
    const Truth other = deciding == kTrue ? kFalse : kTrue;
    if (std::find(left.begin(), left.end(), other) == left.end()) return left;
    const Truths right = TruthsOf(node.right);
    for (std::size_t i = 0; i < offers_; ++i) left[i] = left[i] == other ? right[i] : left[i];
    return left;
  }

  Truths In(const Operands& elements, const PropertyColumn& column) const {
    const auto* text =
        elements.literal != nullptr ? std::get_if<std::string>(elements.literal) : nullptr;
    const auto index = text != nullptr ? std::optional(column.IndexOf(*text)) : std::nullopt;
    return ForEach([&](std::size_t i) -> Operand {
      const Operand element = elements.At(i);
      if (std::holds_alternative<std::monostate>(element)) return kNoOperand;
      return column.ContainsAt(i, element, index);
    });
  }

  Truths Substrings(const Operands& parts, const Operands& wholes) const {
    const auto compute = [](const Operand& a, const Operand& b) { return Substring(a, b); };
    if (auto truths = ByDistinctTexts(parts, wholes, compute)) return *truths;
    return ForEach([&](std::size_t i) { return Substring(parts.At(i), wholes.At(i)); });
  }

  Truths Comparisons(Operator op, const Operands& left, const Operands& right) const {
    Truths truths(offers_);
    const auto compare = [&](const auto& a, const auto& b) {
      WithComparison(op, [&](const auto& holds) { Compare(a, b, holds, truths); });
    };
    if (WithNumbers<double>(left, right, compare) ||
        WithNumbers<std::int64_t>(left, right, compare)) {
      for (const Operands* operands : {&left, &right}) OmitMissing(*operands, truths);
      return truths;
    }
    const auto compute = [op](const Operand& a, const Operand& b) {
      return broker::Compare(op, a, b);
    };
    if (auto by_text = ByDistinctTexts(left, right, compute)) return *by_text;
    return ForEach([&](std::size_t i) { return broker::Compare(op, left.At(i), right.At(i)); });
  }

  // The operands are parameters, and `results` and `count` are local variables. So the compiler
  // knows that the stores do not change them, and compares several numbers in one instruction.
  template <typename Left, typename Right, typename Holds>
  static void Compare(Left a, Right b, const Holds& holds, Truths& truths) {
    Truth* const results = truths.data();
    const std::size_t count = truths.size();
    for (std::size_t i = 0; i < count; ++i) results[i] = holds(a[i], b[i]) ? kTrue : kFalse;
  }

  // Computes the result once for each different text, if one operand is a literal and the other
  // operand is a column of texts. Returns nullopt otherwise.
  template <typename Compute>
  std::optional<Truths> ByDistinctTexts(const Operands& left, const Operands& right,
                                        const Compute& compute) const {
    const bool literal_first = left.literal != nullptr;
    const Operands& texts = literal_first ? right : left;
    const Operands& other = literal_first ? left : right;
    if (other.literal == nullptr || texts.column == nullptr) return std::nullopt;
    if (texts.sole_kind != CellKind::kText) return std::nullopt;
    const Operand literal = ToOperand(*other.literal);
    Truths by_text;
    by_text.reserve(texts.column->texts().size());
    for (const std::string_view text : texts.column->texts()) {
      by_text.push_back(ToTruth(literal_first ? compute(literal, text) : compute(text, literal)));
    }
    Truths truths(offers_);
    for (std::size_t i = 0; i < offers_; ++i) truths[i] = by_text[texts.bits[i]];
    OmitMissing(texts, truths);
    return truths;
  }

  // Sets the result to kNoTruth for each offer whose operand has no value of the kind `sole_kind`.
  static void OmitMissing(const Operands& operands, Truths& truths) {
    if (operands.literal != nullptr || !operands.has_missing) return;
    const CellKind kind = *operands.sole_kind;
    for (std::size_t i = 0; i < truths.size(); ++i) {
      truths[i] = operands.kinds[i] == kind ? truths[i] : kNoTruth;
    }
  }

  Operands Results(Operator op, const Operands& left, const Operands& right) const {
    Operands results;
    results.own_kinds.resize(offers_, CellKind::kReal);
    results.own_bits.resize(offers_);
    const auto real = [&](const auto& a, const auto& b) {
      for (std::size_t i = 0; i < offers_; ++i) {
        results.own_bits[i] = std::bit_cast<std::uint64_t>(RealResult(op, a[i], b[i]));
        if (op == Operator::kDivide && b[i] == 0) results.own_kinds[i] = CellKind::kNone;
      }
    };
    if (WithNumbers<double>(left, right, real)) {
      for (const Operands* operands : {&left, &right}) OmitMissing(*operands, results.own_kinds);
      results.sole_kind = CellKind::kReal;
    } else {
      for (std::size_t i = 0; i < offers_; ++i) {
        const Operand result = Calculate(op, left.At(i), right.At(i));
        SetNumber(result, results.own_kinds[i], results.own_bits[i]);
      }
      results.sole_kind = SoleKindOf(results.own_kinds);
    }
    results.kinds = results.own_kinds;
    results.bits = results.own_bits;
    return results;
  }

  static void OmitMissing(const Operands& operands, std::vector<CellKind>& kinds) {
    if (operands.literal != nullptr || !operands.has_missing) return;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      if (operands.kinds[i] != *operands.sole_kind) kinds[i] = CellKind::kNone;
    }
  }

  static void SetNumber(const Operand& number, CellKind& kind, std::uint64_t& bits) {
    kind = CellKind::kNone;
    if (const auto* integer = std::get_if<std::int64_t>(&number)) {
      kind = CellKind::kInteger;
      bits = static_cast<std::uint64_t>(*integer);
    } else if (const auto* real = std::get_if<double>(&number)) {
      kind = CellKind::kReal;
      bits = std::bit_cast<std::uint64_t>(*real);
    }
  }

  static std::optional<CellKind> SoleKindOf(const std::vector<CellKind>& kinds) {
    CellKind sole = CellKind::kNone;
    for (const CellKind kind : kinds) {
      if (kind == CellKind::kNone || kind == sole) continue;
      if (sole != CellKind::kNone) return std::nullopt;
      sole = kind;
    }
    return sole;
  }

  Operands ToOperands(const Truths& truths) const {
    Operands operands{.sole_kind = CellKind::kBoolean};
    operands.own_kinds.reserve(offers_);
    operands.own_bits.reserve(offers_);
    for (const Truth truth : truths) {
      operands.own_kinds.push_back(truth == kNoTruth ? CellKind::kNone : CellKind::kBoolean);
      operands.own_bits.push_back(truth == kTrue ? 1 : 0);
    }
    operands.kinds = operands.own_kinds;
    operands.bits = operands.own_bits;
    return operands;
  }

  const std::vector<Node>& nodes_;
  const std::vector<std::size_t>& column_of_node_;
  const ColumnConstraint::Columns& columns_;
  const std::size_t offers_;
};

std::vector<Choice> ToChoices(const Truths& truths) {
  std::vector<Choice> choices(truths.size());
  std::transform(truths.begin(), truths.end(), choices.begin(),
                 [](Truth truth) { return truth == kTrue ? Choice::kYes : Choice::kNo; });
  return choices;
}

void MarkUnknown(const PropertyColumn& column, std::vector<Choice>& choices) {
  if (!column.Has(CellKind::kOffer)) return;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (column.kinds()[i] == CellKind::kOffer) choices[i] = Choice::kUnknown;
  }
}

// Combines the choices so far with those of one more term. For each offer, the choice becomes that
// of `choice and term`, which is the smaller one.
void Restrict(const std::vector<Choice>& term, std::vector<Choice>& choices) {
  std::transform(term.begin(), term.end(), choices.begin(), choices.begin(),
                 [](Choice a, Choice b) { return std::min(a, b); });
}

}  // namespace

ColumnConstraint::ColumnConstraint(const Expression& constraint)
    : constraint_(constraint), column_of_node_(constraint.nodes.size()) {
  for (std::size_t i = 0; i < constraint.nodes.size(); ++i) {
    const std::string& name = constraint.nodes[i].property;
    if (name.empty()) continue;
    const auto known = std::find(properties_.begin(), properties_.end(), name);
    column_of_node_[i] = static_cast<std::size_t>(known - properties_.begin());
    if (known == properties_.end()) properties_.push_back(name);
  }
  AddTerms(constraint.nodes.size() - 1);
}

void ColumnConstraint::AddTerms(std::size_t root) {
  const Node& node = constraint_.nodes[root];
  if (node.op == Operator::kAnd) {
    AddTerms(node.left);
    AddTerms(node.right);
    return;
  }
  Term& term = terms_.emplace_back(Term{.root = root});
  AddProperties(root, term.properties);
}

void ColumnConstraint::AddProperties(std::size_t root, std::vector<std::size_t>& properties) const {
  const Node& node = constraint_.nodes[root];
  if (!node.property.empty()) {
    const std::size_t property = column_of_node_[root];
    const auto known = std::find(properties.begin(), properties.end(), property);
    if (known == properties.end()) properties.push_back(property);
  }
  if (node.op == Operator::kLiteral || node.op == Operator::kProperty ||
      node.op == Operator::kExist) {
    return;
  }
  AddProperties(node.left, properties);
  if (node.op != Operator::kNot && node.op != Operator::kIn) AddProperties(node.right, properties);
}

std::vector<Choice> ColumnConstraint::Choose(const Columns& columns, std::size_t offers) const {
  std::vector<Choice> choices(offers, Choice::kYes);
  const Evaluation evaluation(constraint_, column_of_node_, columns, offers);
  for (const Term& term : terms_) {
    const bool missing = std::any_of(term.properties.begin(), term.properties.end(),
                                     [&](std::size_t i) { return columns[i] == nullptr; });
    if (missing) {
      Restrict(std::vector<Choice>(offers, Choice::kUnknown), choices);
      continue;
    }
    std::vector<Choice> chosen = ToChoices(evaluation.TruthsOf(term.root));
    for (const std::size_t property : term.properties) MarkUnknown(*columns[property], chosen);
    Restrict(chosen, choices);
  }
  return choices;
}

}  // namespace gsv::broker
