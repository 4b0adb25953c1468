#include <csignal>
#include <functional>

#include <COS/CosTradingDynamic.hh>

#include "gsv/broker/testing/broker_node.h"

namespace gsv::broker {
namespace {

using CosTrading::Proxy;

CosTrading::PolicySeq Policies(const std::vector<CosTrading::Policy>& policies) {
  CosTrading::PolicySeq result;
  result.length(static_cast<CORBA::ULong>(policies.size()));
  for (CORBA::ULong i = 0; i < result.length(); ++i) result[i] = policies[i];
  return result;
}

CORBA::Any Boolean(bool value) {
  CORBA::Any any;
  any <<= CORBA::Any::from_boolean(value);
  return any;
}

// A broker with proxies for another broker, which offers robots with n from 0 to 4.
class ProxyServantTest : public testing::Test {
 protected:
  ProxyServantTest() : proxy_(near_.lookup_->proxy_if()) {
    for (BrokerNode* node : {&near_, &far_}) {
      node->AddType("Robot", {BrokerNode::Define("site", CORBA::_tc_string,
                                                 BrokerNode::Repository::PROP_READONLY)});
    }
    for (std::int32_t i = 0; i < 5; ++i) far_.Export("Robot", {{"n", Value::Long(i)}});
  }

  std::string Add(const std::string& recipe, const std::vector<Property>& properties = {},
                  bool if_match_all = true, const std::vector<CosTrading::Policy>& policies = {}) {
    const CORBA::String_var id =
        proxy_->export_proxy(far_.lookup_, "Robot", BrokerNode::Sequence(properties), if_match_all,
                             recipe.c_str(), Policies(policies));
    return id.in();
  }
  std::size_t Found(const char* constraint, const std::vector<CosTrading::Policy>& policies = {}) {
    return near_.Query("Robot", constraint, "", policies).offers->length();
  }

  BrokerNode near_;
  BrokerNode far_;
  CosTrading::Proxy_var proxy_;
};

TEST_F(ProxyServantTest, DescribesAndWithdrawsAnExport) {
  const std::string id = Add("site == $(site) and $*", {{"site", Value::String("hall")}}, true,
                             {BrokerNode::Policy("search_card", ULong(3))});
  const Proxy::ProxyInfo_var info = proxy_->describe_proxy(id.c_str());
  EXPECT_STREQ(info->type, "Robot");
  EXPECT_TRUE(info->target->_is_equivalent(far_.lookup_));
  ASSERT_EQ(info->properties.length(), 1u);
  EXPECT_STREQ(info->properties[0].name, "site");
  EXPECT_TRUE(info->if_match_all);
  EXPECT_STREQ(info->recipe, "site == $(site) and $*");
  ASSERT_EQ(info->policies_to_pass_on.length(), 1u);
  EXPECT_STREQ(info->policies_to_pass_on[0].name, "search_card");
  CORBA::ULong card = 0;
  EXPECT_TRUE(info->policies_to_pass_on[0].value >>= card);
  EXPECT_EQ(card, 3u);
  proxy_->withdraw_proxy(id.c_str());
  EXPECT_STREQ(Raised<CosTrading::UnknownOfferId>([&] { proxy_->withdraw_proxy(id.c_str()); }).id,
               id.c_str());
}

TEST_F(ProxyServantTest, RaisesForInvalidExports) {
  const auto add = [&](const char* type, const std::vector<Property>& properties) {
    const CORBA::String_var id =
        proxy_->export_proxy(far_.lookup_, type, BrokerNode::Sequence(properties), true, "$*", {});
  };
  EXPECT_STREQ(Raised<CosTrading::IllegalServiceType>([&] { add("1", {}); }).type, "1");
  EXPECT_STREQ(Raised<CosTrading::UnknownServiceType>([&] { add("Plane", {}); }).type, "Plane");
  near_.types_->mask_type("Robot");
  EXPECT_STREQ(Raised<CosTrading::UnknownServiceType>([&] { add("Robot", {}); }).type, "Robot");
  near_.types_->unmask_type("Robot");
  const Property one{"a", Value::Long(1)};
  EXPECT_STREQ(Raised<CosTrading::DuplicatePropertyName>([&] {
                 add("Robot", {one, one});
               }).name,
               "a");
  EXPECT_STREQ(Raised<CosTrading::IllegalPropertyName>([&] {
                 add("Robot", {{"1", Value::Long(1)}});
               }).name,
               "1");
  const auto mismatch = Raised<CosTrading::PropertyTypeMismatch>([&] {
    add("Robot", {{"site", Value::Long(1)}});
  });
  EXPECT_STREQ(mismatch.type, "Robot");
  EXPECT_STREQ(mismatch.prop.name, "site");
  near_.AddType("Strict",
                {BrokerNode::Define("a", CORBA::_tc_long, BrokerNode::Repository::PROP_MANDATORY)});
  const auto missing = Raised<CosTrading::MissingMandatoryProperty>([&] { add("Strict", {}); });
  EXPECT_STREQ(missing.type, "Strict");
  EXPECT_STREQ(missing.name, "a");

  CosTradingDynamic::DynamicProp dynamic;
  dynamic.eval_if = CosTradingDynamic::DynamicPropEval::_unchecked_narrow(TestService());
  dynamic.returned_type = CORBA::TypeCode::_duplicate(CORBA::_tc_string);
  CosTrading::PropertySeq properties;
  properties.length(1);
  properties[0].name = "site";
  properties[0].value <<= dynamic;
  const auto readonly = Raised<CosTrading::ReadonlyDynamicProperty>([&] {
    const CORBA::String_var id =
        proxy_->export_proxy(far_.lookup_, "Robot", properties, true, "$*", {});
  });
  EXPECT_STREQ(readonly.type, "Robot");
  EXPECT_STREQ(readonly.name, "site");
}

TEST_F(ProxyServantTest, RaisesForInvalidTargetsRecipesAndPolicies) {
  const auto nil = Raised<CosTrading::InvalidLookupRef>([&] {
    const CORBA::String_var id =
        proxy_->export_proxy(CosTrading::Lookup::_nil(), "Robot", {}, true, "$*", {});
  });
  EXPECT_TRUE(CORBA::is_nil(nil.target));
  EXPECT_STREQ(Raised<Proxy::IllegalRecipe>([&] { Add("n == $(n)"); }).recipe, "n == $(n)");
  const CosTrading::Policy policy = BrokerNode::Policy("search_card", ULong(1));
  EXPECT_STREQ(Raised<CosTrading::DuplicatePolicyName>([&] {
                 Add("$*", {}, true, {policy, policy});
               }).name,
               "search_card");
  Raised<CORBA::IMP_LIMIT>([&] { Add(std::string(8193, ' ')); });
  Add(std::string(8192, ' '));
}

TEST_F(ProxyServantTest, DistinguishesOffersFromProxies) {
  const std::string proxy = Add("$*");
  const std::string offer = near_.Export("Robot", {{"n", Value::Long(9)}});
  const auto& registry = near_.register_;
  const std::function<void()> on_proxy[] = {
      [&] { registry->withdraw(proxy.c_str()); },
      [&] { const CosTrading::Register::OfferInfo_var info = registry->describe(proxy.c_str()); },
      [&] { registry->modify(proxy.c_str(), {}, {}); }};
  for (const auto& call : on_proxy) {
    EXPECT_STREQ(Raised<CosTrading::Register::ProxyOfferId>(call).id, proxy.c_str());
  }
  const std::function<void(const char*)> on_offer[] = {
      [&](const char* id) { proxy_->withdraw_proxy(id); },
      [&](const char* id) { const Proxy::ProxyInfo_var info = proxy_->describe_proxy(id); }};
  for (const auto& call : on_offer) {
    EXPECT_STREQ(Raised<Proxy::NotProxyOfferId>([&] { call(offer.c_str()); }).id, offer.c_str());
    EXPECT_STREQ(Raised<CosTrading::IllegalOfferId>([&] { call("x"); }).id, "x");
    EXPECT_STREQ(Raised<CosTrading::UnknownOfferId>([&] { call("00000000-0000000000000001"); }).id,
                 "00000000-0000000000000001");
  }
  CosTrading::OfferIdSeq_var ids;
  CosTrading::OfferIdIterator_var rest;
  near_.admin_->list_proxies(9, ids, rest);
  ASSERT_EQ(ids->length(), 1u);
  EXPECT_STREQ(ids[0], proxy.c_str());
  near_.admin_->list_offers(9, ids, rest);
  ASSERT_EQ(ids->length(), 1u);
  EXPECT_STREQ(ids[0], offer.c_str());
  near_.register_->withdraw_using_constraint("Robot", "");
  near_.admin_->list_proxies(0, ids, rest);
  EXPECT_EQ(ids->length(), 0u);
  ASSERT_FALSE(CORBA::is_nil(rest));
  EXPECT_EQ(rest->max_left(), 1u) << "a proxy is withdrawn by its id alone";
}

TEST_F(ProxyServantTest, ProxyStandsForTheOffersOfItsTarget) {
  Add("($*) and n < $(most)", {{"most", Value::Long(3)}});
  near_.Export("Robot", {{"n", Value::Long(1)}});
  EXPECT_EQ(Found("n >= 1"), 3u) << "one here, 1 and 2 there";
  EXPECT_EQ(Found("n >= 3"), 0u);
  EXPECT_EQ(Found("n >= 1", {BrokerNode::Policy("use_proxy_offers", Boolean(false))}), 1u);
  EXPECT_TRUE(near_.admin_->set_supports_proxy_offers(false));
  EXPECT_FALSE(near_.lookup_->supports_proxy_offers());
  EXPECT_EQ(Found("n >= 1"), 1u);
}

TEST_F(ProxyServantTest, ProxyWithoutMatchAllIsMatchedByItsOwnProperties) {
  Add("", {{"site", Value::String("hall")}}, false);
  EXPECT_EQ(Found("site == 'hall'"), 5u);
  EXPECT_EQ(Found("site == 'yard'"), 0u);
}

TEST_F(ProxyServantTest, PassesPoliciesOn) {
  Add("$*", {}, true, {BrokerNode::Policy("search_card", ULong(2))});
  BrokerNode::Answer answer = near_.Query("Robot");
  EXPECT_EQ(answer.offers->length(), 2u);
  ASSERT_EQ(answer.limits_applied->length(), 1u);
  EXPECT_STREQ(answer.limits_applied[0], "search_card");
  EXPECT_EQ(Found("", {BrokerNode::Policy("search_card", ULong(4))}), 2u)
      << "the proxy's own policy holds";
}

TEST_F(ProxyServantTest, ProxyForItsOwnTraderDoesNotLoop) {
  const CORBA::String_var id = proxy_->export_proxy(near_.lookup_, "Robot", {}, true, "$*", {});
  near_.Export("Robot");
  EXPECT_EQ(Found(""), 1u);
}

TEST_F(ProxyServantTest, MissingTargetIsReported) {
  Add("$*");
  near_.Export("Robot");
  far_.broker_.Send(SIGKILL);
  far_.broker_.Wait();
  BrokerNode::Answer answer = near_.Query("Robot");
  EXPECT_EQ(answer.offers->length(), 1u);
  ASSERT_EQ(answer.limits_applied->length(), 1u);
  EXPECT_STREQ(answer.limits_applied[0], "use_proxy_offers");
}

TEST_F(ProxyServantTest, ReturnsItsComponents) {
  EXPECT_TRUE(near_.lookup_->_is_equivalent(CosTrading::Lookup_var(proxy_->lookup_if())));
  EXPECT_TRUE(proxy_->supports_proxy_offers());
}

}  // namespace
}  // namespace gsv::broker
