#include "gsv/broker/trader/trader.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "gsv/base/check.h"

namespace gsv::broker {
namespace {

constexpr std::uint32_t kStem = 0xABCD;

std::vector<std::string> Names(const QueryResult& result) {
  std::vector<std::string> names;
  for (const OfferPtr& offer : result.offers) {
    names.emplace_back(*offer->properties.Find("name")->AsText());
  }
  return names;
}

using Strings = std::vector<std::string>;

class TraderTest : public testing::Test {
 protected:
  TraderTest() {
    GSV_CHECK(trader_.AddType(
        {.name = "Printer",
         .properties = {{"name", {.scalar = Scalar::kString}, PropertyMode::kMandatoryReadonly},
                        {"cost", {.scalar = Scalar::kDouble}},
                        {"floor", {.scalar = Scalar::kLong}, PropertyMode::kReadonly},
                        {"ppm", {.scalar = Scalar::kLong}, PropertyMode::kMandatory}}}));
    GSV_CHECK(trader_.AddType({.name = "Laser", .super_types = {"Printer"}}));
  }

  std::string Export(const std::string& type, const std::string& name, std::int32_t ppm,
                     std::vector<Property> more = {}) {
    more.push_back({"name", Value::String(name)});
    more.push_back({"ppm", Value::Long(ppm)});
    return trader_.Export(type, "IOR:", std::move(more)).value();
  }

  QueryResult Find(const std::string& constraint, const std::string& preference = "",
                   const ImportPolicies& policies = {}) {
    return trader_.Find({"Printer", constraint, preference, policies}).value();
  }

  Trader trader_{TraderLimits{}, kStem, 1};
};

TEST_F(TraderTest, FindsOffersOfTheTypeAndItsSubTypes) {
  Export("Printer", "p", 1);
  Export("Laser", "l", 2);
  EXPECT_EQ(Names(Find("ppm > 1")), Strings{"l"});
  EXPECT_EQ(Names(Find("", "min ppm")), (Strings{"p", "l"}));
  EXPECT_EQ(Names(Find("", "", {.exact_type_match = true})), Strings{"p"});
  EXPECT_EQ(trader_.Find({.type = "Laser"})->offers.size(), 1u);
}

TEST_F(TraderTest, PutsOffersWithoutAPreferenceValueLast) {
  Export("Printer", "none", 1);
  Export("Printer", "dear", 2, {{"cost", Value::Double(9)}});
  Export("Printer", "cheap", 3, {{"cost", Value::Double(1)}});
  Export("Printer", "also dear", 4, {{"cost", Value::Double(9)}});
  EXPECT_EQ(Names(Find("", "first")), (Strings{"none", "dear", "cheap", "also dear"}));
  EXPECT_EQ(Names(Find("", "min cost")), (Strings{"cheap", "dear", "also dear", "none"}));
  EXPECT_EQ(Names(Find("", "max cost")), (Strings{"dear", "also dear", "cheap", "none"}));
  EXPECT_EQ(Names(Find("", "max -1 * cost")), (Strings{"cheap", "dear", "also dear", "none"}));
  EXPECT_EQ(Names(Find("", "with cost > 5")), (Strings{"dear", "also dear", "none", "cheap"}));
  EXPECT_EQ(Names(Find("", "min 1 / (ppm - 3)")), (Strings{"dear", "none", "also dear", "cheap"}))
      << "-1, 0 (cut from -1/2), 1, and a division by zero";
}

TEST_F(TraderTest, ShufflesTheOffersOfEachRandomQuery) {
  Strings names;
  for (char name = 'a'; name <= 'z'; ++name) {
    names.emplace_back(1, name);
    Export("Printer", names.back(), 1);
  }
  const Strings first = Names(Find("", "random"));
  const Strings second = Names(Find("", "random"));
  EXPECT_TRUE(std::is_permutation(first.begin(), first.end(), names.begin(), names.end()));
  EXPECT_NE(first, names);
  EXPECT_NE(first, second);
}

TEST_F(TraderTest, AppliesCardinalitiesAndReportsTheirNames) {
  for (int i = 0; i < 10; ++i) Export("Printer", std::to_string(i), i);
  EXPECT_EQ(Find("").limits_applied, Strings{});

  const QueryResult searched = Find("ppm >= 2", "", {.search_card = 4});
  EXPECT_EQ(Names(searched), (Strings{"2", "3"}));
  EXPECT_EQ(searched.limits_applied, Strings{"search_card"});

  const QueryResult matched = Find("ppm >= 2", "max ppm", {.match_card = 3});
  EXPECT_EQ(Names(matched), (Strings{"4", "3", "2"})) << "only what matched first is ordered";
  EXPECT_EQ(matched.limits_applied, Strings{"match_card"});

  const QueryResult returned = Find("", "max ppm", {.return_card = 2});
  EXPECT_EQ(Names(returned), (Strings{"9", "8"}));
  EXPECT_EQ(returned.limits_applied, Strings{"return_card"});

  EXPECT_EQ(Find("", "", {.search_card = 10, .match_card = 10, .return_card = 10}).limits_applied,
            Strings{})
      << "a limit that is only just reached keeps nothing back";
  EXPECT_EQ(Find("", "", {.search_card = 0}).offers.size(), 0u);
}

TEST_F(TraderTest, ReadsDefaultsAndMaximaFromItsAttributes) {
  for (int i = 0; i < 10; ++i) Export("Printer", std::to_string(i), i);
  ASSERT_TRUE(trader_.ChangeAttributes([](TraderAttributes& attributes) {
    attributes.def_return_card = 3;
    attributes.max_return_card = 5;
  }));
  EXPECT_EQ(Find("").offers.size(), 3u);
  EXPECT_EQ(Find("", "", {.return_card = 4}).offers.size(), 4u);
  EXPECT_EQ(Find("", "", {.return_card = 8}).offers.size(), 5u);
}

TEST_F(TraderTest, ExcludesOffersWithModifiablePropertiesOnRequest) {
  ASSERT_TRUE(trader_.AddType(
      {.name = "Fixed",
       .properties = {{"name", {.scalar = Scalar::kString}, PropertyMode::kReadonly}}}));
  ASSERT_TRUE(trader_.Export("Fixed", "IOR:", {{"name", Value::String("fixed")}}));
  ASSERT_TRUE(trader_.Export(
      "Fixed", "IOR:", {{"name", Value::String("loose")}, {"extra", Value::Long(1)}}));
  const auto found =
      trader_.Find({.type = "Fixed", .policies = {.use_modifiable_properties = false}});
  EXPECT_EQ(Names(*found), Strings{"fixed"});
}

TEST_F(TraderTest, RejectsInvalidQueriesWithTheirText) {
  const auto refused = [&](const Query& query) { return trader_.Find(query).error(); };
  EXPECT_EQ(refused({.type = "1"}).refusal, Refusal::kIllegalServiceType);
  EXPECT_EQ(refused({.type = "Plotter"}).refusal, Refusal::kUnknownServiceType);
  const TradingError constraint = refused({.type = "Printer", .constraint = "ppm =< 3"});
  EXPECT_EQ(constraint.refusal, Refusal::kIllegalConstraint);
  EXPECT_EQ(constraint.name, "ppm =< 3");
  EXPECT_EQ(constraint.detail, "character 5: expected an operator or the end");
  EXPECT_EQ(refused({.type = "Laser", .constraint = "name == 1"}).refusal,
            Refusal::kIllegalConstraint)
      << "an inherited property's type";
  const TradingError preference = refused({.type = "Printer", .preference = "min name"});
  EXPECT_EQ(preference.refusal, Refusal::kIllegalPreference);
  EXPECT_EQ(preference.name, "min name");
}

TEST_F(TraderTest, ChecksExports) {
  const Property name = {"name", Value::String("x")};
  const Property ppm = {"ppm", Value::Long(1)};
  const auto refused = [&](const std::string& type, std::vector<Property> properties) {
    return trader_.Export(type, "IOR:", std::move(properties)).error();
  };
  EXPECT_EQ(refused("Plotter", {}).refusal, Refusal::kUnknownServiceType);
  const TradingError missing = refused("Laser", {name});
  EXPECT_EQ(missing.refusal, Refusal::kMissingMandatoryProperty);
  EXPECT_EQ(missing.type, "Laser");
  EXPECT_EQ(missing.name, "ppm");
  const TradingError mismatch = refused("Printer", {name, {"ppm", Value::ULong(1)}});
  EXPECT_EQ(mismatch.refusal, Refusal::kPropertyTypeMismatch);
  EXPECT_EQ(mismatch.property->name, "ppm");
  EXPECT_EQ(refused("Printer", {name, ppm, ppm}).refusal, Refusal::kDuplicatePropertyName);
  EXPECT_EQ(refused("Printer", {name, ppm, {"<x", Value::Long(1)}}).refusal,
            Refusal::kIllegalPropertyName);
  const Value dynamic = Value::Other({"struct IDL:omg.org/CosTradingDynamic/DynamicProp:1.0", "",
                                      std::make_shared<PropertyType>()});
  EXPECT_EQ(refused("Printer", {{"name", dynamic}, ppm}).refusal,
            Refusal::kReadonlyDynamicProperty);
  EXPECT_EQ(refused("Printer", {name, ppm, {"cost", dynamic}}).refusal,
            Refusal::kPropertyTypeMismatch);
  ASSERT_TRUE(trader_.MaskType("Laser"));
  EXPECT_EQ(refused("Laser", {name, ppm}).refusal, Refusal::kUnknownServiceType) << "masked";
  EXPECT_EQ(Find("").offers.size(), 0u) << "what is refused changes nothing";
}

TEST_F(TraderTest, ModifiesAllOrNothing) {
  const std::string id = Export("Printer", "p", 1, {{"cost", Value::Double(5)}});
  ASSERT_TRUE(trader_.Modify(
      id, {.remove = {"cost"}, .set = {{"ppm", Value::Long(2)}, {"floor", Value::Long(3)}}}));
  const PropertyList changed = (*trader_.Describe(id))->properties;
  EXPECT_EQ(changed.Find("cost"), nullptr);
  EXPECT_EQ(*changed.Find("ppm"), Value::Long(2));
  EXPECT_EQ(*changed.Find("floor"), Value::Long(3)) << "read-only, and not given before";

  const auto refused = [&](Modification modification) {
    modification.set.push_back({"cost", Value::Double(1)});
    const TradingError error = trader_.Modify(id, std::move(modification)).error();
    EXPECT_EQ((*trader_.Describe(id))->properties.Find("cost"), nullptr);
    return error;
  };
  EXPECT_EQ(refused({.remove = {"weight"}, .set = {}}).refusal, Refusal::kUnknownPropertyName);
  EXPECT_EQ(refused({.remove = {"ppm"}, .set = {}}).refusal, Refusal::kMandatoryProperty);
  EXPECT_EQ(refused({.remove = {}, .set = {{"name", Value::String("q")}}}).refusal,
            Refusal::kReadonlyProperty);
  EXPECT_EQ(refused({.remove = {}, .set = {{"floor", Value::Long(4)}}}).refusal,
            Refusal::kReadonlyProperty);
  EXPECT_EQ(refused({.remove = {}, .set = {{"ppm", Value::String("1")}}}).refusal,
            Refusal::kPropertyTypeMismatch);
  EXPECT_EQ(refused({.remove = {"floor"}, .set = {{"floor", Value::Long(1)}}}).refusal,
            Refusal::kDuplicatePropertyName);
  EXPECT_EQ(refused({.remove = {"1"}, .set = {}}).refusal, Refusal::kIllegalPropertyName);

  ASSERT_TRUE(trader_.ChangeAttributes(
      [](TraderAttributes& attributes) { attributes.supports_modifiable_properties = false; }));
  EXPECT_EQ(refused({}).refusal, Refusal::kNotImplemented);
}

TEST_F(TraderTest, DistinguishesForgedOldAndUnknownIds) {
  const std::string id = Export("Printer", "p", 1);
  EXPECT_EQ(trader_.Withdraw("printer 1").error().refusal, Refusal::kIllegalOfferId);
  EXPECT_EQ(trader_.Withdraw("").error().refusal, Refusal::kIllegalOfferId);
  Trader restarted(TraderLimits{}, kStem + 1, 1);
  EXPECT_EQ(restarted.Withdraw(id).error().refusal, Refusal::kUnknownOfferId);
  EXPECT_TRUE(trader_.Withdraw(id));
  EXPECT_EQ(trader_.Withdraw(id).error().refusal, Refusal::kUnknownOfferId);
  EXPECT_EQ(trader_.Describe(id).error().name, id);
}

TEST_F(TraderTest, WithdrawsMatchingOffers) {
  Export("Printer", "a", 1);
  Export("Laser", "b", 2);
  Export("Printer", "c", 3);
  EXPECT_EQ(*trader_.WithdrawMatching("Printer", "ppm <= 2"), 2u);
  EXPECT_EQ(Names(Find("")), Strings{"c"});
  const auto none = trader_.WithdrawMatching("Printer", "ppm <= 2");
  EXPECT_EQ(none.error().refusal, Refusal::kNoMatchingOffers);
  EXPECT_EQ(none.error().name, "ppm <= 2");
  EXPECT_EQ(trader_.WithdrawMatching("Printer", "(").error().refusal, Refusal::kIllegalConstraint);
}

TEST(Trader, RejectsRequestsBeyondItsLimits) {
  TraderLimits limits;
  limits.offers = 1;
  limits.properties_per_offer = 2;
  limits.offer_bytes = 500;
  Trader trader(limits, 1, 1);
  ASSERT_TRUE(trader.AddType({.name = "T"}));
  const auto refused = [&](std::vector<Property> properties) {
    return trader.Export("T", "IOR:", std::move(properties)).error().refusal;
  };
  EXPECT_EQ(refused({{"a", Value::Long(1)}, {"b", Value::Long(1)}, {"c", Value::Long(1)}}),
            Refusal::kLimit);
  EXPECT_EQ(refused({{"a", Value::String(std::string(500, 'x'))}}), Refusal::kLimit);
  const std::string id = trader.Export("T", "IOR:", {}).value();
  EXPECT_EQ(refused({}), Refusal::kLimit);
  EXPECT_EQ(trader.Modify(id, {.remove = {}, .set = {{"a", Value::String(std::string(500, 'x'))}}})
                .error()
                .refusal,
            Refusal::kLimit);
}

TEST(Trader, FindsOffersAmongAHundredThousand) {
  Trader trader(TraderLimits{}, 1, 1);
  ASSERT_TRUE(trader.AddType({.name = "T"}));
  constexpr std::int32_t kOffers = 100'000;
  for (std::int32_t i = 0; i < kOffers; ++i) {
    ASSERT_TRUE(trader.Export("T", "IOR:", {{"n", Value::Long(i)}, {"rest", Value::Long(i % 7)}}));
  }
  const auto found = trader.Find({.type = "T", .constraint = "rest == 3", .preference = "max n"});
  ASSERT_EQ(found->offers.size(), 14286u) << "3, 10, …, 99,998";
  EXPECT_EQ(*found->offers.front()->properties.Find("n"), Value::Long(99'998));
  EXPECT_EQ(*found->offers.back()->properties.Find("n"), Value::Long(3));
}

}  // namespace
}  // namespace gsv::broker
