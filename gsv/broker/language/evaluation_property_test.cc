// Evaluates random constraints on random offers, and compares the evaluator with a second, naive
// one.
#include <gtest/gtest.h>

#include "gsv/broker/language/evaluation.h"
#include "gsv/broker/testing/naive_evaluator.h"
#include "gsv/broker/testing/random_constraints.h"

namespace gsv::broker {
namespace {

TEST(EvaluationProperty, AgreesWithTheNaiveEvaluator) {
  constexpr int kRounds = 20'000;
  RandomConstraints generator(20'240'601);
  int matches = 0;
  for (int round = 0; round < kRounds; ++round) {
    const PropertyList offer = generator.Offer();
    const std::string text = generator.Constraint();
    const auto constraint = ParseConstraint(text, {});
    ASSERT_TRUE(constraint) << text << ": " << constraint.error().Sentence();
    const bool expected = NaivelyMatches(text, offer);
    ASSERT_EQ(Matches(*constraint, offer), expected) << "round " << round << ": " << text;
    matches += expected ? 1 : 0;
  }
  // The test is significant only if both outcomes are frequent.
  EXPECT_GT(matches, kRounds / 10);
  EXPECT_LT(matches, kRounds * 9 / 10);
}

}  // namespace
}  // namespace gsv::broker
