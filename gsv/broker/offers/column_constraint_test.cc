// Compares constraints over columns with a second, naive evaluator on random offers.
#include "gsv/broker/offers/column_constraint.h"

#include <memory>

#include <gtest/gtest.h>

#include "gsv/broker/language/evaluation.h"
#include "gsv/broker/testing/naive_evaluator.h"
#include "gsv/broker/testing/random_constraints.h"

namespace gsv::broker {
namespace {

OfferPtr OfferWith(PropertyList properties) {
  return std::make_shared<const Offer>(Offer{.properties = std::move(properties)});
}

ColumnConstraint::Columns ColumnsOf(const ColumnConstraint& constraint, const Offers& offers) {
  ColumnConstraint::Columns columns;
  for (const std::string& property : constraint.properties()) {
    columns.push_back(std::make_shared<const PropertyColumn>(offers, property));
  }
  return columns;
}

std::vector<Choice> Choose(const std::string& text, const Offers& offers) {
  const Expression expression = ParseConstraint(text, {}).value();
  const ColumnConstraint constraint(expression);
  return constraint.Choose(ColumnsOf(constraint, offers), offers.size());
}

// Compares the choices with naive results. `of_one_type` makes offers that differ in the values of
// their properties only, so that whole columns have one type.
void CompareWithNaiveEvaluator(std::uint64_t seed, bool of_one_type) {
  constexpr int kRounds = 1500;
  constexpr std::size_t kOffers = 24;
  RandomConstraints random(seed);
  int matches = 0;
  for (int round = 0; round < kRounds; ++round) {
    Offers offers;
    PropertyList first = random.Offer();
    while (offers.size() < kOffers) {
      PropertyList properties = of_one_type ? random.OfferLike(first) : random.Offer();
      offers.push_back(OfferWith(std::move(properties)));
    }
    const std::string text = random.Constraint();
    const std::vector<Choice> choices = Choose(text, offers);
    for (std::size_t i = 0; i < kOffers; ++i) {
      const bool expected = NaivelyMatches(text, offers[i]->properties);
      ASSERT_EQ(choices[i], expected ? Choice::kYes : Choice::kNo)
          << "round " << round << ", offer " << i << ": " << text;
      matches += expected ? 1 : 0;
    }
  }
  // The test is significant only if both outcomes are frequent.
  const int total = kRounds * static_cast<int>(kOffers);
  EXPECT_GT(matches, total / 20);
  EXPECT_LT(matches, total * 19 / 20);
}

TEST(ColumnConstraint, AgreesWithTheNaiveEvaluatorOnMixedTypes) {
  CompareWithNaiveEvaluator(1, false);
}

TEST(ColumnConstraint, AgreesWithTheNaiveEvaluatorOnColumnsOfOneType) {
  CompareWithNaiveEvaluator(2, true);
}

TEST(ColumnConstraint, NumbersBeyondDoublesAreExact) {
  const std::int64_t large = (std::int64_t{1} << 53) + 1;
  Offers offers;
  for (const std::int64_t number : {large - 1, large, large + 1}) {
    offers.push_back(OfferWith(PropertyList({{"n", Value::Of(Scalar::kLong, number)}})));
  }
  using Choices = std::vector<Choice>;
  EXPECT_EQ(Choose("n == 9007199254740993", offers),
            (Choices{Choice::kNo, Choice::kYes, Choice::kNo}));
  EXPECT_EQ(Choose("n > 9007199254740992.0", offers),
            (Choices{Choice::kNo, Choice::kYes, Choice::kYes}));
}

TEST(ColumnConstraint, EvaluatesAnOfferOnlyIfNoOtherTermIsFalse) {
  const auto promised = std::make_shared<const PropertyType>(PropertyType{.scalar = Scalar::kLong});
  const Value dynamic = Value::Other({"struct", "", promised});
  const Offers offers = {OfferWith(PropertyList({{"a", dynamic}, {"b", Value::Long(1)}})),
                         OfferWith(PropertyList({{"a", dynamic}, {"b", Value::Long(3)}})),
                         OfferWith(PropertyList({{"a", Value::Long(7)}, {"b", Value::Long(3)}}))};
  EXPECT_EQ(Choose("a > 5 and b > 2", offers),
            (std::vector<Choice>{Choice::kNo, Choice::kUnknown, Choice::kYes}));
}

TEST(ColumnConstraint, TermWithoutColumnIsUnknown) {
  const Expression expression = ParseConstraint("a > 5 and b > 2", {}).value();
  const ColumnConstraint constraint(expression);
  const Offers offers = {OfferWith(PropertyList({{"a", Value::Long(1)}, {"b", Value::Long(3)}})),
                         OfferWith(PropertyList({{"a", Value::Long(7)}, {"b", Value::Long(3)}}))};
  ColumnConstraint::Columns columns = ColumnsOf(constraint, offers);
  columns[1] = nullptr;
  EXPECT_EQ(constraint.Choose(columns, offers.size()),
            (std::vector<Choice>{Choice::kNo, Choice::kUnknown}));
}

}  // namespace
}  // namespace gsv::broker
