#include "gsv/broker/language/explanation.h"

#include <gtest/gtest.h>

namespace gsv::broker {
namespace {

using TermResult = TermOutcome::Result;

const PropertyList kRobotOffer({{"name", Value::String("r2")}, {"speed", Value::Double(2)}});

std::vector<TermOutcome> Outcomes(const std::string& constraint) {
  return Explain(*ParseConstraint(constraint, {}), kRobotOffer);
}

TEST(Explanation, EvaluatesEachTermSeparately) {
  const auto outcomes = Outcomes("speed > 1 and speed > 3 and range < 5 and 'r' ~ name");
  ASSERT_EQ(outcomes.size(), 4u);
  EXPECT_EQ(outcomes[0].result, TermResult::kTrue);
  EXPECT_EQ(outcomes[1].result, TermResult::kFalse);
  EXPECT_EQ(outcomes[2].result, TermResult::kNoValue);
  EXPECT_EQ(outcomes[2].missing, std::vector<std::string>{"range"});
  EXPECT_EQ(outcomes[3].result, TermResult::kTrue);
}

TEST(Explanation, WritesTermsWithTheSameMeaning) {
  EXPECT_EQ(Outcomes("speed>1 or not exist speed")[0].term, "(speed > 1) or (not exist speed)");
  EXPECT_EQ(Outcomes("speed * 2 + 1 == 5")[0].term, "((speed * 2) + 1) == 5");
  EXPECT_EQ(Outcomes("name == 'it\\'s'")[0].term, "name == 'it\\'s'");
  EXPECT_EQ(Outcomes("3 in ranges")[0].term, "3 in ranges");
  EXPECT_EQ(Outcomes("")[0].term, "TRUE");
}

TEST(Explanation, DoesNotReportMissingPropertiesForATypeMismatch) {
  const auto outcomes = Outcomes("name > 3");
  EXPECT_EQ(outcomes[0].result, TermResult::kNoValue);
  EXPECT_TRUE(outcomes[0].missing.empty());
}

}  // namespace
}  // namespace gsv::broker
