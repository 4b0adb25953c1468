#include "gsv/broker/client/broker_administration.h"

#include <chrono>
#include <csignal>
#include <latch>
#include <sstream>
#include <thread>

#include <COS/CosTradingDynamic.hh>

#include "gsv/broker/client/offer_listing.h"
#include "gsv/broker/testing/broker_node.h"

namespace gsv::broker {
namespace {

TEST(BrokerAdministration, AddsListsAndRemovesLinks) {
  TestOrb();
  BrokerProcess broker;
  BrokerProcess other;
  const BrokerAdministration administration(broker.reference());
  ASSERT_TRUE(administration.AddLink("north",
                                     "corbaloc::127.0.0.1:" + other.port() + "/TradingService",
                                     FollowOption::kLocalOnly, FollowOption::kIfNoLocal));
  std::ostringstream json;
  PrintLinksJson(*administration.ListLinks(), json);
  EXPECT_EQ(json.str(), R"({"name":"north","address":"127.0.0.1:)" + other.port() +
                            R"(","def_pass_on_follow_rule":"local_only",)" +
                            R"("limiting_follow_rule":"if_no_local","answers":true})" + "\n");
  other.Send(SIGKILL);
  other.Wait();
  std::ostringstream text;
  PrintLinks(*administration.ListLinks(), text);
  EXPECT_EQ(text.str(), "north  127.0.0.1:" + other.port() +
                            "  local_only, at most if_no_local  (does not respond)\n");
  ASSERT_TRUE(administration.RemoveLink("north"));
  EXPECT_TRUE(administration.ListLinks()->empty());
}

// A service whose calls wait for each other. Each call counts `others` down, and returns when
// `others` is 0. So no call returns if the caller makes one call after the other.
class ConcurrentEvaluator : public POA_CosTradingDynamic::DynamicPropEval {
 public:
  explicit ConcurrentEvaluator(std::latch& others) : others_(others) {}
  CORBA::Any* evalDP(const char*, CORBA::TypeCode_ptr, const CORBA::Any&) override {
    return new CORBA::Any;
  }
  CORBA::Boolean _non_existent() override {
    others_.count_down();
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!others_.try_wait()) {
      if (std::chrono::steady_clock::now() > deadline) throw CORBA::TRANSIENT();
      std::this_thread::yield();
    }
    return false;
  }

 private:
  std::latch& others_;
};

// Several silent traders together must take no longer than one silent trader.
TEST(BrokerAdministration, CallsTheTargetsOfLinksConcurrently) {
  constexpr int kLinks = 4;
  const BrokerNode node;
  std::latch others(kLinks);
  const CORBA::Object_var root = TestOrb()->resolve_initial_references("RootPOA");
  const PortableServer::POA_var poa = PortableServer::POA::_narrow(root);
  for (int i = 0; i < kLinks; ++i) {
    const PortableServer::Servant_var<ConcurrentEvaluator> target(new ConcurrentEvaluator(others));
    const PortableServer::ObjectId_var id = poa->activate_object(target);
    const CORBA::Object_var object =
        poa->create_reference_with_id(id, CosTrading::Lookup::_PD_repoId);
    node.link_->add_link(("l" + std::to_string(i)).c_str(),
                         CosTrading::Lookup_var(CosTrading::Lookup::_unchecked_narrow(object)),
                         CosTrading::always, CosTrading::always);
  }
  const auto links = BrokerAdministration(node.broker_.reference()).ListLinks();
  ASSERT_TRUE(links) << links.error().Sentence();
  ASSERT_EQ(links->size(), kLinks);
  for (const LinkDescription& link : *links) EXPECT_TRUE(link.answers) << link.name;
}

TEST(BrokerAdministration, ReportsTheErrorOfALink) {
  TestOrb();
  BrokerProcess broker;
  const BrokerAdministration administration(broker.reference());
  const auto add = [&](const char* name, FollowOption pass_on, FollowOption limiting) {
    const auto added = administration.AddLink(name, broker.reference(), pass_on, limiting);
    return added ? std::string() : added.error().message;
  };
  EXPECT_EQ(add("1st", FollowOption::kAlways, FollowOption::kAlways),
            "\"1st\" is not a valid name of a link");
  EXPECT_EQ(add("north", FollowOption::kAlways, FollowOption::kLocalOnly),
            "the default follow policy of the link is more permissive than its limiting policy");
  EXPECT_EQ(add("north", FollowOption::kAlways, FollowOption::kAlways), "");
  EXPECT_EQ(add("north", FollowOption::kAlways, FollowOption::kAlways),
            "a link named north exists already; remove it first, or choose another name");
  EXPECT_EQ(administration.RemoveLink("west").error().message,
            "the broker has no link named west; `gsv links` lists its links");
  EXPECT_EQ(administration.AddLink("west", "nonsense", {}, {}).error().code,
            base::ErrorCode::kInvalidArgument);
}

TEST(BrokerAdministration, AddsAndRemovesTypesAndOffers) {
  BrokerNode node;
  const BrokerAdministration administration(node.broker_.reference());
  ServiceType type{.name = "Robot"};
  for (const char* text :
       {"mandatory readonly string name", "unsigned short wheels", "sequence<double> sizes"}) {
    type.properties.push_back(*ParsePropertyDefinition(text));
  }
  ASSERT_TRUE(administration.AddServiceType(type));
  std::ostringstream types;
  PrintServiceTypes(*ListServiceTypes(node.broker_.reference()), types);
  EXPECT_EQ(types.str(),
            "Robot  \n  mandatory readonly string name\n  unsigned short wheels\n"
            "  sequence<double> sizes\n");

  const CORBA::String_var ior = TestOrb()->object_to_string(TestService());
  const auto id = administration.AddOffer("Robot", ior.in(),
                                          {"name=42", "wheels=4", "sizes=[1, 2.5]", "spare=true"});
  ASSERT_TRUE(id) << id.error().Sentence();
  EXPECT_EQ(node.Query("Robot", "name == '42' and wheels == 4 and 2.5 in sizes and spare == TRUE")
                .offers->length(),
            1u);
  ASSERT_TRUE(administration.RemoveOffer(*id));
  EXPECT_EQ(administration.RemoveOffer(*id).error().code, base::ErrorCode::kNotFound);
  ASSERT_TRUE(administration.RemoveServiceType("Robot"));
  EXPECT_EQ(administration.RemoveServiceType("Robot").error().code, base::ErrorCode::kNotFound);
}

TEST(PropertyTexts, RejectValuesOfTheWrongType) {
  const ServiceType type{.name = "T",
                         .properties = {*ParsePropertyDefinition("short a"),
                                        *ParsePropertyDefinition("unsigned long b"),
                                        *ParsePropertyDefinition("char c"),
                                        *ParsePropertyDefinition("sequence<long> d")}};
  for (const char* good : {"a=-32768", "b=4294967295", "c=x", "c=7", "d=[]", "e=[true]", "f=text",
                           "g=1.5", "h=", "i=[\"a\"]"}) {
    EXPECT_TRUE(ParseProperty(good, type)) << good;
  }
  for (const char* bad :
       {"a=-32769", "a=1.5", "a=x", "b=-1", "b=4294967296", "c=xy", "c=", "d=1", "d=[1.5]",
        "d=[9999999999]", "e=[1,true]", "f={}", "g", "h=99999999999"}) {
    EXPECT_FALSE(ParseProperty(bad, type)) << bad;
  }
  for (const char* bad : {"", "name", "text name", "mandatory", "long  name", "mandatory long "}) {
    const auto parsed = ParsePropertyDefinition(bad);
    EXPECT_TRUE(!parsed || parsed->name.empty()) << bad;
  }
}

}  // namespace
}  // namespace gsv::broker
