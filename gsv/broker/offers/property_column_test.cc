// Compares queries that use property columns with an evaluation of each offer.
#include <algorithm>
#include <limits>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "gsv/broker/language/evaluation.h"
#include "gsv/broker/trader/trader.h"

namespace gsv::broker {
namespace {

class RandomOffers {
 public:
  std::size_t Below(std::size_t limit) { return random_() % limit; }

  Value AnyValue() {
    const auto small = static_cast<std::int32_t>(Below(5));
    switch (Below(6)) {
      case 0:
        return Value::Double(small + 0.5);
      case 1:
        return Value::Double(std::numeric_limits<double>::quiet_NaN());
      case 2:
        return Value::String("text");
      case 3:
        return Value::Float(static_cast<float>(small));
      default:
        return Value::Long(small);
    }
  }
  std::vector<Property> Properties() {
    std::vector<Property> properties;
    for (const char* name : {"a", "b", "c"}) {
      if (Below(8) != 0) properties.push_back({name, AnyValue()});
    }
    return properties;
  }
  std::string Term() {
    const std::string property = Pick({"a", "b", "c"});
    const std::string literal = Pick({"0", "1", "2.5", "3", "-1"});
    const std::string op = Pick({" == ", " != ", " < ", " <= ", " > ", " >= "});
    switch (Below(6)) {
      case 0:
        return literal + op + property;
      case 1:
        return "exist " + property;
      case 2:
        return "(" + property + op + literal + " or " + property + " == 2)";
      default:
        return property + op + literal;
    }
  }
  std::string Constraint() {
    std::string text = Term();
    for (std::size_t i = Below(3); i > 0; --i) text += " and " + Term();
    return text;
  }

 private:
  std::string Pick(const std::vector<const char*>& choices) {
    return choices[Below(choices.size())];
  }

  std::mt19937_64 random_{6};
};

std::vector<std::uint64_t> OfferNumbers(const auto& offers) {
  std::vector<std::uint64_t> numbers;
  for (const OfferPtr& offer : offers) numbers.push_back(offer->number);
  return numbers;
}

std::vector<std::uint64_t> OneByOne(const Trader& trader, const std::string& text) {
  Offers matching;
  const auto constraint = ParseConstraint(text, {});
  for (const OfferPtr& offer : trader.AllOffers()) {
    if (Matches(*constraint, offer->properties)) matching.push_back(offer);
  }
  return OfferNumbers(matching);
}

TEST(PropertyColumns, FindTheSameOffersAsAnEvaluationOfEachOffer) {
  RandomOffers random;
  Trader trader(TraderLimits{}, 1, 1);
  ASSERT_TRUE(trader.AddType({.name = "Robot"}));
  constexpr int kOffers = 2000;
  std::vector<std::string> ids;
  ids.reserve(kOffers);
  for (int i = 0; i < kOffers; ++i) {
    ids.push_back(*trader.Export("Robot", "IOR:00", random.Properties()));
  }
  for (int round = 0; round < 100; ++round) {
    const std::string text = random.Constraint();
    const std::vector<std::uint64_t> expected = OneByOne(trader, text);
    // The first query evaluates each offer, the second one makes the columns, and the third one
    // uses them. All three must find the same offers.
    for (int i = 0; i < 3; ++i) {
      const auto found = trader.Find({.type = "Robot", .constraint = text});
      ASSERT_TRUE(found) << text;
      ASSERT_EQ(OfferNumbers(found->offers), expected) << text;
    }
    if (round % 4 != 0) continue;
    const std::string& changed = ids[random.Below(ids.size())];
    ASSERT_TRUE(trader.Modify(changed, {.set = {{"a", random.AnyValue()}}}));
    ASSERT_TRUE(trader.Withdraw(ids.back()));
    ids.pop_back();
  }
}

// Returns the offers with a number in `property`, smallest (or largest) first, and then the others.
std::vector<std::uint64_t> OneByOneInOrder(const Trader& trader, const std::string& property,
                                           bool greatest_first) {
  const auto expression = ParseConstraint(property, {});
  std::vector<std::pair<long double, std::uint64_t>> with_number;
  std::vector<std::uint64_t> without;
  for (const OfferPtr& offer : trader.AllOffers()) {
    const auto number = EvaluateNumber(*expression, offer->properties);
    if (number) with_number.emplace_back(greatest_first ? -*number : *number, offer->number);
    if (!number) without.push_back(offer->number);
  }
  std::sort(with_number.begin(), with_number.end());
  std::vector<std::uint64_t> numbers;
  numbers.reserve(with_number.size() + without.size());
  for (const auto& [number, offer] : with_number) numbers.push_back(offer);
  numbers.insert(numbers.end(), without.begin(), without.end());
  return numbers;
}

TEST(PropertyColumns, OrderLikeAnEvaluationOfEachOffer) {
  RandomOffers random;
  Trader trader(TraderLimits{}, 1, 1);
  ASSERT_TRUE(trader.AddType({.name = "Robot"}));
  for (int i = 0; i < 2000; ++i) {
    ASSERT_TRUE(trader.Export("Robot", "IOR:00", random.Properties()));
  }
  for (int round = 0; round < 6; ++round) {
    for (const bool greatest_first : {false, true}) {
      const std::string preference = greatest_first ? "max b" : "min b";
      const auto found = trader.Find({.type = "Robot", .preference = preference});
      ASSERT_TRUE(found);
      EXPECT_EQ(OfferNumbers(found->offers), OneByOneInOrder(trader, "b", greatest_first));
    }
    // Every second round adds an offer, so the chunk with this offer has no column. In the next
    // round, the first query evaluates each offer of this chunk. The second query makes its column.
    if (round % 2 == 1) {
      ASSERT_TRUE(trader.Export("Robot", "IOR:00", random.Properties()));
    }
  }
}

// A service whose value is 5.
class Five : public DynamicEvaluator {
 public:
  std::optional<Value> Evaluate(const std::string&, const OtherValue&, Clock::time_point) override {
    return Value::Long(5);
  }
};

TEST(PropertyColumns, OrderDynamicPropertiesAmongTheOthers) {
  Trader trader(TraderLimits{}, 1, 1);
  ASSERT_TRUE(trader.AddType({.name = "Robot"}));
  const auto promised = std::make_shared<const PropertyType>(PropertyType{.scalar = Scalar::kLong});
  for (int i = 0; i < 2000; ++i) {
    const Value value = i == 3 ? Value::Other({"struct", "", promised}) : Value::Long(i % 10);
    ASSERT_TRUE(trader.Export("Robot", "IOR:00", {{"b", value}}));
  }
  Five five;
  for (int i = 0; i < 3; ++i) {
    DynamicValues values(&five, std::chrono::seconds(1));
    const auto found = trader.Find({.type = "Robot", .preference = "min b"}, values);
    ASSERT_TRUE(found);
    // Offers 1, 11, … have the value 0, so offer 1 is first. Offer 4 has the dynamic property,
    // whose value is 5. Before it are the offers with the values 0 to 4: 199 with the value 3, and
    // 200 with each of the other values.
    EXPECT_EQ(found->offers[0]->number, 1u);
    EXPECT_EQ(found->offers[200 + 200 + 200 + 199 + 200]->number, 4u);
  }
}

}  // namespace
}  // namespace gsv::broker
