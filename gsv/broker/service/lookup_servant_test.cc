#include <COS/CosTradingDynamic.hh>

#include "gsv/broker/testing/broker_fixture.h"

namespace gsv::broker {
namespace {

class LookupServantTest : public BrokerFixture {
 protected:
  LookupServantTest() { AddType("Robot"); }

  void ExportNumbered(std::int32_t count) {
    for (std::int32_t i = 0; i < count; ++i) Export("Robot", {{"n", Value::Long(i)}});
  }

  static CORBA::Long Number(const CosTrading::Offer& offer) {
    CORBA::Long number = -1;
    for (CORBA::ULong i = 0; i < offer.properties.length(); ++i) {
      if (std::string(offer.properties[i].name) == "n") offer.properties[i].value >>= number;
    }
    return number;
  }

  static CORBA::Any ULong(CORBA::ULong value) {
    CORBA::Any any;
    any <<= value;
    return any;
  }
  static CORBA::Any Boolean(bool value) {
    CORBA::Any any;
    any <<= CORBA::Any::from_boolean(value);
    return any;
  }
};

TEST_F(LookupServantTest, ReturnsReferencesAndPropertiesAsTheyWereExported) {
  Export("Robot", {{"n", Value::Long(7)}, {"tags", Value::Strings({"a", "b"})}});
  Answer answer = Query("Robot", "'b' in tags");
  ASSERT_EQ(answer.offers->length(), 1u);
  const CosTrading::Offer& offer = answer.offers[0];
  EXPECT_TRUE(offer.reference->_is_equivalent(TestService()));
  EXPECT_EQ(offer.properties.length(), 2u);
  EXPECT_EQ(Number(offer), 7);
  EXPECT_TRUE(CORBA::is_nil(answer.rest));
  EXPECT_EQ(answer.limits_applied->length(), 0u);
}

TEST_F(LookupServantTest, ReturnsOnlyDesiredProperties) {
  Export("Robot", {{"a", Value::Long(1)}, {"b", Value::Long(2)}});
  Lookup::SpecifiedProps desired;
  desired._d(Lookup::none);
  EXPECT_EQ(Query("Robot", "", "", {}, 9, desired).offers[0].properties.length(), 0u);
  CosTrading::PropertyNameSeq names;
  names.length(2);
  names[0] = "b";
  names[1] = "absent";
  desired.prop_names(names);
  Answer answer = Query("Robot", "", "", {}, 9, desired);
  ASSERT_EQ(answer.offers[0].properties.length(), 1u);
  EXPECT_STREQ(answer.offers[0].properties[0].name, "b");

  names[1] = "b";
  desired.prop_names(names);
  EXPECT_STREQ(Raised<CosTrading::DuplicatePropertyName>([&] {
                 Query("Robot", "", "", {}, 9, desired);
               }).name,
               "b");
  names[1] = "<foo-bar";
  desired.prop_names(names);
  EXPECT_STREQ(
      Raised<CosTrading::IllegalPropertyName>([&] { Query("Robot", "", "", {}, 9, desired); }).name,
      "<foo-bar");
}

TEST_F(LookupServantTest, RaisesWithTheInvalidText) {
  EXPECT_STREQ(Raised<CosTrading::IllegalServiceType>([&] { Query("1"); }).type, "1");
  EXPECT_STREQ(Raised<CosTrading::UnknownServiceType>([&] { Query("Plane"); }).type, "Plane");
  EXPECT_STREQ(Raised<CosTrading::IllegalConstraint>([&] { Query("Robot", "n =< 1"); }).constr,
               "n =< 1");
  EXPECT_STREQ(Raised<Lookup::IllegalPreference>([&] { Query("Robot", "", "least n"); }).pref,
               "least n");
}

TEST_F(LookupServantTest, AppliesCardinalityPolicies) {
  ExportNumbered(10);
  Answer searched = Query("Robot", "", "", {Policy("search_card", ULong(4))});
  EXPECT_EQ(searched.offers->length(), 4u);
  ASSERT_EQ(searched.limits_applied->length(), 1u);
  EXPECT_STREQ(searched.limits_applied[0], "search_card");

  Answer several = Query("Robot", "", "max n",
                         {Policy("match_card", ULong(5)), Policy("return_card", ULong(2))});
  ASSERT_EQ(several.offers->length(), 2u);
  EXPECT_EQ(Number(several.offers[0]), 4);
  ASSERT_EQ(several.limits_applied->length(), 2u);
  EXPECT_STREQ(several.limits_applied[0], "match_card");
  EXPECT_STREQ(several.limits_applied[1], "return_card");

  admin_->set_max_return_card(3);
  EXPECT_EQ(Query("Robot", "", "", {Policy("return_card", ULong(8))}).offers->length(), 3u);
}

TEST_F(LookupServantTest, AppliesExactTypeMatch) {
  AddType("Rover", {}, {"Robot"});
  Export("Robot");
  Export("Rover");
  EXPECT_EQ(Query("Robot").offers->length(), 2u);
  EXPECT_EQ(Query("Robot", "", "", {Policy("exact_type_match", Boolean(true))}).offers->length(),
            1u);
}

TEST_F(LookupServantTest, AppliesUseModifiableProperties) {
  AddType("Fixed", {Define("a", CORBA::_tc_long, Repository::PROP_READONLY)});
  Export("Fixed", {{"a", Value::Long(1)}});
  Export("Fixed", {{"a", Value::Long(1)}, {"b", Value::Long(1)}});
  EXPECT_EQ(Query("Fixed").offers->length(), 2u);
  EXPECT_EQ(Query("Fixed", "", "", {Policy("use_modifiable_properties", Boolean(false))})
                .offers->length(),
            1u);
}

TEST_F(LookupServantTest, AcceptsEveryPolicyOfTheStandard) {
  ExportNumbered(1);
  CORBA::Any follow;
  follow <<= CosTrading::always;
  CORBA::Any trader_name;
  trader_name <<= CosTrading::TraderName();
  CORBA::Any request_id;
  CosTrading::Admin::OctetSeq octets;
  octets.length(4);
  request_id <<= octets;
  Answer answer = Query(
      "Robot", "", "",
      {Policy("exact_type_match", Boolean(false)), Policy("hop_count", ULong(3)),
       Policy("link_follow_rule", follow), Policy("match_card", ULong(9)),
       Policy("return_card", ULong(9)), Policy("search_card", ULong(9)),
       Policy("starting_trader", trader_name), Policy("use_dynamic_properties", Boolean(false)),
       Policy("use_modifiable_properties", Boolean(true)),
       Policy("use_proxy_offers", Boolean(false)), Policy("request_id", request_id),
       Policy("somebody_elses_policy", ULong(1))});
  EXPECT_EQ(answer.offers->length(), 1u);
}

TEST_F(LookupServantTest, RaisesForInvalidPolicies) {
  const auto illegal = Raised<Lookup::IllegalPolicyName>(
      [&] { Query("Robot", "", "", {Policy("search card", ULong(1))}); });
  EXPECT_STREQ(illegal.name, "search card");
  const auto duplicate = Raised<CosTrading::DuplicatePolicyName>([&] {
    Query("Robot", "", "", {Policy("hop_count", ULong(1)), Policy("hop_count", ULong(1))});
  });
  EXPECT_STREQ(duplicate.name, "hop_count");
  for (const char* name : {"search_card", "match_card", "return_card", "hop_count",
                           "link_follow_rule", "starting_trader", "request_id"}) {
    const auto mismatch = Raised<Lookup::PolicyTypeMismatch>(
        [&] { Query("Robot", "", "", {Policy(name, Boolean(true))}); });
    EXPECT_STREQ(mismatch.the_policy.name, name);
    CORBA::Boolean value = false;
    EXPECT_TRUE(mismatch.the_policy.value >>= CORBA::Any::to_boolean(value)) << name;
  }
  for (const char* name : {"exact_type_match", "use_dynamic_properties",
                           "use_modifiable_properties", "use_proxy_offers"}) {
    const auto mismatch = Raised<Lookup::PolicyTypeMismatch>(
        [&] { Query("Robot", "", "", {Policy(name, ULong(1))}); });
    EXPECT_STREQ(mismatch.the_policy.name, name);
  }
  CosTrading::TraderName elsewhere;
  elsewhere.length(1);
  elsewhere[0] = "elsewhere";
  CORBA::Any trader_name;
  trader_name <<= elsewhere;
  const auto invalid = Raised<Lookup::InvalidPolicyValue>(
      [&] { Query("Robot", "", "", {Policy("starting_trader", trader_name)}); });
  EXPECT_STREQ(invalid.the_policy.name, "starting_trader");
}

TEST_F(LookupServantTest, ReturnsTheRestThroughAnIterator) {
  ExportNumbered(10);
  Answer answer = Query("Robot", "", "max n", {}, 3);
  ASSERT_EQ(answer.offers->length(), 3u);
  EXPECT_EQ(Number(answer.offers[2]), 7);
  ASSERT_FALSE(CORBA::is_nil(answer.rest));
  EXPECT_EQ(answer.rest->max_left(), 7u);
  CosTrading::OfferSeq_var next;
  EXPECT_TRUE(answer.rest->next_n(5, next));
  ASSERT_EQ(next->length(), 5u);
  EXPECT_EQ(Number(next[0]), 6);
  EXPECT_EQ(answer.rest->max_left(), 2u);
  EXPECT_FALSE(answer.rest->next_n(5, next));
  ASSERT_EQ(next->length(), 2u);
  EXPECT_EQ(Number(next[1]), 0);
  EXPECT_FALSE(answer.rest->next_n(5, next));
  EXPECT_EQ(next->length(), 0u);
  answer.rest->destroy();
  Raised<CORBA::OBJECT_NOT_EXIST>([&] { answer.rest->max_left(); });
  Raised<CORBA::OBJECT_NOT_EXIST>([&] { answer.rest->next_n(1, next); });
  Raised<CORBA::OBJECT_NOT_EXIST>([&] { answer.rest->destroy(); });
}

TEST_F(LookupServantTest, ReturnsEverythingThroughTheIteratorIfHowManyIsZero) {
  ExportNumbered(2);
  Answer answer = Query("Robot", "", "", {}, 0);
  EXPECT_EQ(answer.offers->length(), 0u);
  ASSERT_FALSE(CORBA::is_nil(answer.rest));
  EXPECT_EQ(answer.rest->max_left(), 2u);
}

TEST_F(LookupServantTest, KeepsEachReplyWithinAMessage) {
  const std::string text(10'000, 'x');
  for (int i = 0; i < 20; ++i) Export("Robot", {{"text", Value::String(text)}});
  Answer answer = Query("Robot");
  std::size_t count = answer.offers->length();
  EXPECT_LT(count, 6u);
  ASSERT_FALSE(CORBA::is_nil(answer.rest));
  for (bool more = true; more;) {
    more = answer.rest->next_n(100, answer.offers);
    ASSERT_GT(answer.offers->length(), 0u);
    count += answer.offers->length();
  }
  EXPECT_EQ(count, 20u);
}

TEST_F(LookupServantTest, AppliesMaxList) {
  ExportNumbered(5);
  admin_->set_max_list(2);
  Answer answer = Query("Robot");
  EXPECT_EQ(answer.offers->length(), 2u);
  CosTrading::OfferSeq_var next;
  EXPECT_TRUE(answer.rest->next_n(100, next));
  EXPECT_EQ(next->length(), 2u);
}

TEST_F(LookupServantTest, ReturnsItsComponentsAndAttributes) {
  EXPECT_TRUE(lookup_->_is_equivalent(CosTrading::Lookup_var(register_->lookup_if())));
  EXPECT_TRUE(register_->_is_equivalent(CosTrading::Register_var(lookup_->register_if())));
  EXPECT_FALSE(CORBA::is_nil(CosTrading::Link_var(lookup_->link_if())));
  EXPECT_FALSE(CORBA::is_nil(CosTrading::Proxy_var(lookup_->proxy_if())));
  EXPECT_FALSE(CORBA::is_nil(CosTrading::Admin_var(register_->admin_if())));
  EXPECT_TRUE(lookup_->supports_modifiable_properties());
  EXPECT_TRUE(lookup_->supports_dynamic_properties());
  EXPECT_TRUE(register_->supports_proxy_offers());
  admin_->set_def_search_card(1);
  admin_->set_max_search_card(2);
  admin_->set_def_match_card(3);
  admin_->set_max_match_card(4);
  admin_->set_def_return_card(5);
  admin_->set_max_return_card(6);
  admin_->set_max_list(7);
  admin_->set_def_hop_count(8);
  EXPECT_NE(admin_->set_max_hop_count(9), 9u) << "what held before";
  EXPECT_EQ(admin_->set_max_hop_count(9), 9u);
  admin_->set_def_follow_policy(CosTrading::local_only);
  admin_->set_max_follow_policy(CosTrading::if_no_local);
  EXPECT_EQ(lookup_->def_search_card(), 1u);
  EXPECT_EQ(lookup_->max_search_card(), 2u);
  EXPECT_EQ(lookup_->def_match_card(), 3u);
  EXPECT_EQ(lookup_->max_match_card(), 4u);
  EXPECT_EQ(lookup_->def_return_card(), 5u);
  EXPECT_EQ(lookup_->max_return_card(), 6u);
  EXPECT_EQ(lookup_->max_list(), 7u);
  EXPECT_EQ(lookup_->def_hop_count(), 8u);
  EXPECT_EQ(lookup_->max_hop_count(), 9u);
  EXPECT_EQ(lookup_->def_follow_policy(), CosTrading::local_only);
  EXPECT_EQ(lookup_->max_follow_policy(), CosTrading::if_no_local);
}

class IteratorLimitTest : public BrokerFixture {
 protected:
  IteratorLimitTest() : BrokerFixture({"0", "iterators=2"}) {}
};

TEST_F(IteratorLimitTest, RemovesTheOldestIterator) {
  AddType("Robot");
  for (int i = 0; i < 4; ++i) Export("Robot");
  Answer first = Query("Robot", "", "", {}, 1);
  Answer second = Query("Robot", "", "", {}, 1);
  Answer third = Query("Robot", "", "", {}, 1);
  Raised<CORBA::OBJECT_NOT_EXIST>([&] { first.rest->max_left(); });
  EXPECT_EQ(second.rest->max_left(), 3u);
  EXPECT_EQ(third.rest->max_left(), 3u);
}

TEST_F(LookupServantTest, ListsTheIdsOfAllOffers) {
  ExportNumbered(5);
  CosTrading::OfferIdSeq_var ids;
  CosTrading::OfferIdIterator_var rest;
  admin_->list_offers(2, ids, rest);
  EXPECT_EQ(ids->length(), 2u);
  ASSERT_FALSE(CORBA::is_nil(rest));
  EXPECT_EQ(rest->max_left(), 3u);
  EXPECT_FALSE(rest->next_n(9, ids));
  EXPECT_EQ(ids->length(), 3u);
  rest->destroy();
  Raised<CORBA::OBJECT_NOT_EXIST>([&] { rest->max_left(); });
}

TEST_F(LookupServantTest, RejectsAnotherTypeRepository) {
  Raised<CORBA::NO_IMPLEMENT>([&] { admin_->set_type_repos(TestService()); });
  const CORBA::Object_var same = admin_->set_type_repos(types_);
  EXPECT_TRUE(same->_is_equivalent(types_));
}

}  // namespace
}  // namespace gsv::broker
