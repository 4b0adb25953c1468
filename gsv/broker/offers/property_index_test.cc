// Compares an index with an evaluation of each offer.
#include "gsv/broker/offers/property_index.h"

#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "gsv/broker/language/evaluation.h"
#include "gsv/broker/trader/trader.h"

namespace gsv::broker {
namespace {

class RandomValues {
 public:
  explicit RandomValues(std::uint64_t seed) : random_(seed) {}

  std::size_t Below(std::size_t bound) { return random_() % bound; }

  // Returns a random value. Some of the values are equal although their types differ. Some values
  // equal no other value.
  Value AnyValue() {
    const auto small = static_cast<std::int32_t>(Below(4));
    switch (Below(9)) {
      case 0:
        return Value::Boolean(small == 0);
      case 1:
        return Value::Double(small == 3 ? std::nan("") : small == 2 ? -0.0 : small);
      case 2:
        return Value::Float(0.5f * static_cast<float>(small));
      case 3:
        return Value::String(std::string(1, static_cast<char>('a' + small)));
      case 4:
        return Value::Char(static_cast<char>('a' + small));
      case 5:
        return Value::Strings({"a"});
      case 6:
        return Value::Other({.type_name = "dynamic",
                             .encoded = "",
                             .promised_type = std::make_shared<const PropertyType>(
                                 PropertyType{.scalar = Scalar::kLong})});
      case 7:
        return Value::UShort(static_cast<std::uint16_t>(small));
      default:
        return Value::Long(small);
    }
  }

  std::vector<Property> Properties() {
    std::vector<Property> properties;
    for (const char* name : {"a", "b", "c", "d"}) {
      if (Below(8) != 0) properties.push_back({name, AnyValue()});
    }
    return properties;
  }

  std::string Term() {
    const std::string name = Pick({"a", "b", "c", "d"});
    const std::string literal =
        Pick({"0", "1", "2.0", "0.5", "'a'", "'b'", "TRUE", "FALSE", "-0.0", "''"});
    switch (Below(6)) {
      case 0:
        return literal + " == " + name;
      case 1:
        return name + " != " + literal;
      case 2:
        return "exist " + name;
      case 3:
        return "(" + name + " == " + literal + " or " + Pick({"a", "b"}) + " == 1)";
      default:
        return name + " == " + literal;
    }
  }

  std::string Constraint() {
    std::string constraint = Term();
    for (std::size_t i = Below(3); i > 0; --i) constraint += " and " + Term();
    return constraint;
  }

 private:
  std::string Pick(const std::vector<const char*>& choices) {
    return choices[Below(choices.size())];
  }

  std::mt19937_64 random_;
};

TEST(PropertyIndex, FindsTheSameOffersAsAnEvaluationOfEachOffer) {
  RandomValues random(20261121);
  Trader trader(TraderLimits{}, 1, 1);
  ASSERT_TRUE(trader.AddType({.name = "Robot"}));
  ASSERT_TRUE(trader.AddType({.name = "Rover", .super_types = {"Robot"}}));
  std::vector<std::string> ids;
  const auto add = [&] {
    const auto id =
        trader.Export(random.Below(3) == 0 ? "Rover" : "Robot", "IOR:00", random.Properties());
    ASSERT_TRUE(id);
    ids.push_back(*id);
  };
  for (int i = 0; i < 600; ++i) add();

  for (int round = 0; round < 600; ++round) {
    const std::string text = random.Constraint();
    const auto constraint = ParseConstraint(text, {});
    ASSERT_TRUE(constraint) << text;
    std::vector<std::uint64_t> expected;
    for (const char* type : {"Robot", "Rover"}) {
      for (const OfferPtr& offer : trader.AllOffers()) {
        DynamicValues none(nullptr, {});
        if (*offer->type == type && Matches(*constraint, EvaluatedOffer(*offer, none))) {
          expected.push_back(offer->number);
        }
      }
    }
    const auto found = trader.Find({.type = "Robot", .constraint = text});
    ASSERT_TRUE(found) << text;
    std::vector<std::uint64_t> numbers;
    for (const OfferPtr& offer : found->offers) numbers.push_back(offer->number);
    ASSERT_EQ(numbers, expected) << text;

    add();
    const std::size_t victim = random.Below(ids.size());
    ASSERT_TRUE(trader.Withdraw(ids[victim]));
    ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(victim));
    const std::string& changed = ids[random.Below(ids.size())];
    ASSERT_TRUE(trader.Modify(changed, {.set = {{"a", random.AnyValue()}}}));
  }
}

TEST(PropertyIndex, IndexedQueryAppliesTheCardinalityPolicies) {
  Trader trader(TraderLimits{}, 1, 1);
  ASSERT_TRUE(trader.AddType({.name = "Robot"}));
  for (std::int32_t i = 0; i < 1000; ++i) {
    ASSERT_TRUE(trader.Export("Robot", "IOR:00", {{"n", Value::Long(i % 10)}}));
  }
  const auto count = [&](const ImportPolicies& policies) {
    return trader.Find({.type = "Robot", .constraint = "n == 3", .policies = policies})
        ->offers.size();
  };
  EXPECT_EQ(count({}), 100u);
  EXPECT_EQ(count({.search_card = 500}), 50u);
  EXPECT_EQ(count({.match_card = 7}), 7u);
}

TEST(PropertyIndex, KeepsProxiesThatMatchEveryQuery) {
  Trader trader(TraderLimits{}, 1, 1);
  ASSERT_TRUE(trader.AddType({.name = "Robot"}));
  for (std::int32_t i = 0; i < 1000; ++i) {
    ASSERT_TRUE(trader.Export("Robot", "IOR:00", {{"n", Value::Long(i)}}));
  }
  ASSERT_TRUE(trader.ExportProxy("Robot", "IOR:01", {{"n", Value::Long(7)}},
                                 {.if_match_all = true, .recipe = "$*"}));
  ASSERT_TRUE(trader.ExportProxy("Robot", "IOR:02", {{"n", Value::Long(3)}}, {.recipe = "$*"}));
  DynamicValues none(nullptr, {});
  for (int i = 0; i < 2; ++i) {
    const auto matches = trader.FindMatching({.type = "Robot", .constraint = "n == 3"}, none);
    ASSERT_TRUE(matches);
    EXPECT_EQ(matches->offers.size(), 1u);
    EXPECT_EQ(matches->proxies.size(), 2u);
  }
}

}  // namespace
}  // namespace gsv::broker
