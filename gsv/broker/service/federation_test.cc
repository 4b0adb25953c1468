// Tests several linked brokers, each in its own process.
#include <csignal>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>
#include <thread>

#include "gsv/base/temporary_folder.h"
#include "gsv/broker/testing/broker_node.h"

namespace gsv::broker {
namespace {

CosTrading::Policy Follow(CosTrading::FollowOption rule) {
  CORBA::Any any;
  any <<= rule;
  return BrokerNode::Policy("link_follow_rule", any);
}

CosTrading::Policy StartingAt(const std::vector<const char*>& names) {
  CosTrading::TraderName name;
  name.length(static_cast<CORBA::ULong>(names.size()));
  for (CORBA::ULong i = 0; i < name.length(); ++i) name[i] = names[i];
  CORBA::Any any;
  any <<= name;
  return BrokerNode::Policy("starting_trader", any);
}

CORBA::Long Number(const CosTrading::Offer& offer) {
  CORBA::Long number = -1;
  for (CORBA::ULong i = 0; i < offer.properties.length(); ++i) {
    if (std::string(offer.properties[i].name) == "n") offer.properties[i].value >>= number;
  }
  return number;
}

std::vector<CORBA::Long> Numbers(BrokerNode::Answer& answer) {
  std::vector<CORBA::Long> numbers;
  for (CORBA::ULong i = 0; i < answer.offers->length(); ++i) {
    numbers.push_back(Number(answer.offers[i]));
  }
  return numbers;
}

std::set<std::string> Limits(BrokerNode::Answer answer) {
  std::set<std::string> names;
  for (CORBA::ULong i = 0; i < answer.limits_applied->length(); ++i) {
    names.emplace(answer.limits_applied[i]);
  }
  return names;
}

using Names = std::set<std::string>;
using Sequence = std::vector<CORBA::Long>;

// Several brokers. Broker i has an offer of type "Robot" whose property n is i.
class FederationTest : public testing::Test {
 protected:
  void Start(std::size_t count, const std::vector<std::string>& arguments = {"0"}) {
    for (std::size_t i = 0; i < count; ++i) {
      nodes_.push_back(std::make_unique<BrokerNode>(arguments));
      nodes_[i]->AddType("Robot");
      nodes_[i]->Export("Robot", {{"n", Value::Long(static_cast<std::int32_t>(i))}});
    }
  }
  BrokerNode& Node(std::size_t i) { return *nodes_[i]; }
  void Connect(std::size_t from, std::size_t to) {
    Node(from).LinkTo(Node(to), ("to" + std::to_string(to)).c_str());
  }

  std::vector<std::unique_ptr<BrokerNode>> nodes_;
};

// The brokers form a ring in both directions with chords, so many paths lead to each broker and
// back.
TEST_F(FederationTest, TenBrokersInCyclesReturnEachOfferOnce) {
  Start(10);
  for (std::size_t i = 0; i < 10; ++i) {
    Connect(i, (i + 1) % 10);
    Connect(i, (i + 9) % 10);
    Connect(i, (i + 5) % 10);
  }
  for (std::size_t from = 0; from < 10; ++from) {
    BrokerNode::Answer answer =
        Node(from).Query("Robot", "n >= 0", "max n",
                         {Follow(CosTrading::always), BrokerNode::Policy("hop_count", ULong(10))});
    EXPECT_EQ(Numbers(answer), (Sequence{9, 8, 7, 6, 5, 4, 3, 2, 1, 0})) << "from " << from;
    EXPECT_EQ(Limits(answer), Names{});
  }
}

TEST_F(FederationTest, QueryMakesAtMostItsNumberOfHops) {
  Start(4);
  for (std::size_t i = 0; i < 3; ++i) Connect(i, i + 1);
  const auto count_with = [&](CORBA::ULong hops, const Names& limits) {
    BrokerNode::Answer answer =
        Node(0).Query("Robot", "", "",
                      {Follow(CosTrading::always), BrokerNode::Policy("hop_count", ULong(hops))});
    EXPECT_EQ(Limits(answer), limits) << hops;
    return answer.offers->length();
  };
  EXPECT_EQ(count_with(0, {"hop_count"}), 1u);
  EXPECT_EQ(count_with(1, {"hop_count"}), 2u);
  EXPECT_EQ(count_with(2, {"hop_count"}), 3u);
  EXPECT_EQ(count_with(3, {}), 4u);
  Node(1).admin_->set_max_hop_count(0);
  EXPECT_EQ(count_with(3, {"hop_count"}), 2u);
}

TEST_F(FederationTest, LinksAreFollowedByTheRules) {
  Start(2);
  Node(0).LinkTo(Node(1), "other", CosTrading::local_only, CosTrading::if_no_local);
  EXPECT_EQ(Node(0).Query("Robot").offers->length(), 1u) << "there is one here";
  EXPECT_EQ(Node(0).Query("Robot", "n == 1").offers->length(), 1u) << "there is none here";
  EXPECT_EQ(Node(0).Query("Robot", "n == 1", "", {Follow(CosTrading::local_only)}).offers->length(),
            0u);
  EXPECT_EQ(Node(0).Query("Robot", "", "", {Follow(CosTrading::always)}).offers->length(), 1u)
      << "the link follows less";
  Node(0).link_->modify_link("other", CosTrading::local_only, CosTrading::always);
  EXPECT_EQ(Node(0).Query("Robot", "", "", {Follow(CosTrading::always)}).offers->length(), 2u);
  Node(0).admin_->set_max_follow_policy(CosTrading::local_only);
  EXPECT_EQ(Node(0).Query("Robot", "n == 1", "", {Follow(CosTrading::always)}).offers->length(),
            0u);
}

// If the importer sets no rule, the link's default is passed to the next trader.
TEST_F(FederationTest, LinksDefaultRuleIsPassedToTheNextTrader) {
  Start(3);
  Node(0).LinkTo(Node(1), "near", CosTrading::local_only);
  Connect(1, 2);
  EXPECT_EQ(Node(0).Query("Robot", "n == 2").offers->length(), 0u);
  Node(0).link_->modify_link("near", CosTrading::if_no_local, CosTrading::always);
  EXPECT_EQ(Node(0).Query("Robot", "n == 2").offers->length(), 1u);
}

TEST_F(FederationTest, PreferenceOrdersByPropertiesThatAreNotRequested) {
  Start(3);
  Connect(0, 1);
  Connect(0, 2);
  for (std::size_t i = 0; i < 3; ++i) {
    Node(i).Export("Robot", {{"n", Value::Long(static_cast<std::int32_t>(10 + i))},
                             {"rank", Value::Double(3.0 - static_cast<double>(i))}});
  }
  CosTrading::Lookup::SpecifiedProps desired;
  CosTrading::PropertyNameSeq names;
  names.length(1);
  names[0] = "n";
  desired.prop_names(names);
  BrokerNode::Answer answer =
      Node(0).Query("Robot", "exist rank", "min rank", {Follow(CosTrading::always)}, 10, desired);
  EXPECT_EQ(Numbers(answer), (Sequence{12, 11, 10}));
  for (CORBA::ULong i = 0; i < 3; ++i) EXPECT_EQ(answer.offers[i].properties.length(), 1u);

  answer = Node(0).Query("Robot", "exist rank", "min rank",
                         {Follow(CosTrading::always), BrokerNode::Policy("return_card", ULong(2))},
                         10, desired);
  EXPECT_EQ(Numbers(answer), (Sequence{12, 11})) << "cut after it was ordered";
  EXPECT_EQ(Limits(answer), Names{"return_card"});
}

TEST_F(FederationTest, ManyOffersAreFetchedThroughIteratorsOfOtherTraders) {
  Start(2);
  Connect(0, 1);
  for (std::int32_t i = 2; i < 1500; ++i) Node(1).Export("Robot", {{"n", Value::Long(i)}});
  BrokerNode::Answer answer = Node(0).Query("Robot", "", "min n", {Follow(CosTrading::always)}, 1);
  ASSERT_FALSE(CORBA::is_nil(answer.rest));
  EXPECT_EQ(answer.rest->max_left(), 1499u);
}

TEST_F(FederationTest, TypeThatAnotherTraderDoesNotKnowIsNoError) {
  Start(2);
  Connect(0, 1);
  Node(0).AddType("Rover");
  BrokerNode::Answer answer = Node(0).Query("Rover");
  EXPECT_EQ(answer.offers->length(), 0u);
  EXPECT_EQ(Limits(answer), Names{});
}

TEST_F(FederationTest, QueryCanStartAtAnotherTrader) {
  Start(3);
  Node(0).LinkTo(Node(1), "near", CosTrading::local_only, CosTrading::local_only);
  Node(1).LinkTo(Node(2), "far", CosTrading::local_only, CosTrading::local_only);
  BrokerNode::Answer near = Node(0).Query("Robot", "", "", {StartingAt({"near"})});
  EXPECT_EQ(Numbers(near), Sequence{1});
  BrokerNode::Answer far = Node(0).Query("Robot", "", "", {StartingAt({"near", "far"})});
  EXPECT_EQ(Numbers(far), Sequence{2});
  const auto unknown = Raised<CosTrading::Lookup::InvalidPolicyValue>(
      [&] { Node(0).Query("Robot", "", "", {StartingAt({"nowhere"})}); });
  EXPECT_STREQ(unknown.the_policy.name, "starting_trader");
  EXPECT_STREQ(Raised<CosTrading::UnknownServiceType>([&] {
                 Node(0).Query("Plane", "", "", {StartingAt({"near"})});
               }).type,
               "Plane");
  Node(1).broker_.Send(SIGKILL);
  Node(1).broker_.Wait();
  Raised<CORBA::TIMEOUT>([&] { Node(0).Query("Robot", "", "", {StartingAt({"near"})}); });
}

TEST_F(FederationTest, ResolvesTheRegistersOfOtherTraders) {
  Start(3);
  Node(0).LinkTo(Node(1), "near");
  Node(1).LinkTo(Node(2), "far");
  CosTrading::TraderName name;
  name.length(1);
  name[0] = "near";
  const CosTrading::Register_var near = Node(0).register_->resolve(name);
  EXPECT_TRUE(near->_is_equivalent(Node(1).register_));
  name.length(2);
  name[1] = "far";
  const CosTrading::Register_var far = Node(0).register_->resolve(name);
  EXPECT_TRUE(far->_is_equivalent(Node(2).register_));
  name[1] = "nowhere";
  const auto unknown =
      Raised<CosTrading::Register::UnknownTraderName>([&] { Node(0).register_->resolve(name); });
  ASSERT_EQ(unknown.name.length(), 1u);
  EXPECT_STREQ(unknown.name[0], "nowhere");
  Node(1).broker_.Send(SIGKILL);
  Node(1).broker_.Wait();
  const auto unsupported =
      Raised<CosTrading::Register::RegisterNotSupported>([&] { Node(0).register_->resolve(name); });
  EXPECT_EQ(unsupported.name.length(), 2u);
}

TEST_F(FederationTest, RepeatedRequestIsNotAnsweredAgain) {
  Start(1);
  CosTrading::Admin::OctetSeq id;
  id.length(3);
  CORBA::Any any;
  any <<= id;
  const std::vector<CosTrading::Policy> policies = {BrokerNode::Policy("request_id", any)};
  EXPECT_EQ(Node(0).Query("Robot", "", "", policies).offers->length(), 1u);
  EXPECT_EQ(Node(0).Query("Robot", "", "", policies).offers->length(), 0u);
  EXPECT_EQ(Node(0).Query("Robot").offers->length(), 1u);
  id.length(1025);
  any <<= id;
  EXPECT_STREQ(Raised<CosTrading::Lookup::InvalidPolicyValue>([&] {
                 Node(0).Query("Robot", "", "", {BrokerNode::Policy("request_id", any)});
               }).the_policy.name,
               "request_id");
}

TEST_F(FederationTest, KilledTraderIsReported) {
  Start(3);
  Connect(0, 1);
  Connect(0, 2);
  Node(1).broker_.Send(SIGKILL);
  Node(1).broker_.Wait();
  BrokerNode::Answer answer = Node(0).Query("Robot", "", "min n", {Follow(CosTrading::always)});
  EXPECT_EQ(Numbers(answer), (Sequence{0, 2}));
  EXPECT_EQ(Limits(answer), Names{"link_follow_rule"});
  Node(0).broker_.Send(SIGTERM);
  Node(0).broker_.Wait();
  const std::string output = Node(0).broker_.Stderr();
  EXPECT_NE(output.find("link to1"), std::string::npos) << output;
  EXPECT_NE(output.find("does not respond"), std::string::npos) << output;
}

// One trader on the way is stopped. The traders before it still answer in time.
TEST_F(FederationTest, HangingTraderDelaysAQueryByAtMostItsTimeout) {
  Start(4, {"0", "per_hop_ms=250"});
  Connect(0, 1);
  Connect(1, 2);
  Connect(0, 3);
  Node(2).broker_.Stop();
  const std::vector<CosTrading::Policy> policies = {Follow(CosTrading::always),
                                                    BrokerNode::Policy("hop_count", ULong(4))};
  BrokerNode::Answer answer = Node(0).Query("Robot", "", "min n", policies);
  EXPECT_EQ(Numbers(answer), (Sequence{0, 1, 3}));
  EXPECT_EQ(Limits(answer), Names{"link_follow_rule"});
  Node(2).broker_.Send(SIGCONT);
  while (Numbers(answer) != Sequence{0, 1, 2, 3}) {
    answer = Node(0).Query("Robot", "", "min n", policies);
  }
  EXPECT_EQ(Limits(answer), Names{});
}

std::size_t DescriptorsOf(pid_t process) {
  namespace fs = std::filesystem;
  const fs::directory_iterator all("/proc/" + std::to_string(process) + "/fd");
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

// The call would take seven seconds, which is two seconds more than the ORB waits for calls in
// progress when it shuts down.
TEST_F(FederationTest, BrokerStopsCleanlyWhileACallWaitsForAnotherBroker) {
  Start(2, {"0", "per_hop_ms=1400"});
  Connect(0, 1);
  Node(1).broker_.Stop();
  const std::size_t before = DescriptorsOf(Node(0).broker_.pid());
  std::jthread asker([&] {
    try {
      Node(0).Query("Robot", "", "",
                    {Follow(CosTrading::always), BrokerNode::Policy("hop_count", ULong(5))});
    } catch (const CORBA::Exception&) {
      // The broker has ended, so the query gets no answer.
    }
  });
  while (DescriptorsOf(Node(0).broker_.pid()) == before) {
  }
  Node(0).broker_.Send(SIGTERM);
  EXPECT_EQ(Node(0).broker_.Wait(), 0);
}

TEST_F(FederationTest, LinksAndAttributesSurviveAKill) {
  Start(1);
  const auto folder = base::TemporaryFolder::Make("gsv-test");
  ASSERT_TRUE(folder);
  const std::vector<std::string> arguments = {"0",
                                              "data=" + (folder->path() / "broker.db").string()};
  {
    BrokerNode linked(arguments);
    linked.LinkTo(Node(0), "gone");
    linked.LinkTo(Node(0), "kept", CosTrading::local_only, CosTrading::if_no_local);
    linked.link_->remove_link("gone");
    linked.admin_->set_max_list(7);
    linked.admin_->set_def_follow_policy(CosTrading::local_only);
    linked.broker_.Send(SIGKILL);
    linked.broker_.Wait();
  }
  const BrokerNode again(arguments);
  CosTrading::LinkNameSeq_var names = again.link_->list_links();
  ASSERT_EQ(names->length(), 1u);
  EXPECT_STREQ(names[0], "kept");
  const CosTrading::Link::LinkInfo_var info = again.link_->describe_link("kept");
  EXPECT_TRUE(info->target->_is_equivalent(Node(0).lookup_));
  EXPECT_EQ(info->def_pass_on_follow_rule, CosTrading::local_only);
  EXPECT_EQ(info->limiting_follow_rule, CosTrading::if_no_local);
  EXPECT_EQ(again.lookup_->max_list(), 7u);
  EXPECT_EQ(again.lookup_->def_follow_policy(), CosTrading::local_only);
}

}  // namespace
}  // namespace gsv::broker
