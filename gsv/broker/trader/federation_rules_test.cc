#include "gsv/broker/trader/federation.h"

#include <gtest/gtest.h>

#include "gsv/broker/trader/attribute_texts.h"
#include "gsv/broker/trader/request_history.h"

namespace gsv::broker {
namespace {

constexpr FollowOption kAll[] = {FollowOption::kLocalOnly, FollowOption::kIfNoLocal,
                                 FollowOption::kAlways};

// Every combination must give the minimum of the rules that apply, as the standard says.
TEST(Federation, FollowsAndForwardsTheLeastPermissiveRule) {
  for (const FollowOption def : kAll) {
    for (const FollowOption most : kAll) {
      for (const FollowOption limiting : kAll) {
        for (const FollowOption pass_on : kAll) {
          const TraderAttributes attributes{.def_follow_policy = def, .max_follow_policy = most};
          const TraderLink link{.name = "l", .def_pass_on = pass_on, .limiting = limiting};
          EXPECT_EQ(FollowRule(link, {}, attributes), std::min(std::min(def, most), limiting));
          EXPECT_EQ(PassOnRule(link, {}, attributes), std::min(pass_on, most));
          for (const FollowOption asked : kAll) {
            const ImportPolicies policies{.link_follow_rule = asked};
            const FollowOption least = std::min(std::min(asked, most), limiting);
            EXPECT_EQ(FollowRule(link, policies, attributes), least);
            EXPECT_EQ(PassOnRule(link, policies, attributes), least);
          }
        }
      }
    }
  }
}

TEST(Federation, FollowsIfNoLocalOnlyWithoutLocalOffers) {
  const std::vector<TraderLink> links = {{.name = "always", .limiting = FollowOption::kAlways},
                                         {.name = "maybe", .limiting = FollowOption::kIfNoLocal},
                                         {.name = "never", .limiting = FollowOption::kLocalOnly}};
  const ImportPolicies policies{.link_follow_rule = FollowOption::kAlways};
  const auto with_local = LinksToFollow(links, policies, {}, true);
  ASSERT_EQ(with_local.size(), 1u);
  EXPECT_EQ(with_local[0].name, "always");
  const auto without_local = LinksToFollow(links, policies, {}, false);
  ASSERT_EQ(without_local.size(), 2u);
  EXPECT_EQ(without_local[1].name, "maybe");
}

TEST(Federation, HopCountIsAtMostTheMaximumOfTheTrader) {
  const TraderAttributes attributes{.def_hop_count = 3, .max_hop_count = 7};
  EXPECT_EQ(EffectiveHopCount({}, attributes), 3u);
  EXPECT_EQ(EffectiveHopCount({.hop_count = 5}, attributes), 5u);
  EXPECT_EQ(EffectiveHopCount({.hop_count = 9}, attributes), 7u);
  EXPECT_EQ(EffectiveHopCount({}, {.def_hop_count = 8, .max_hop_count = 7}), 7u);
}

class RequestHistoryTest : public testing::Test {
 protected:
  std::chrono::steady_clock::time_point now_;
  RequestHistory history_{3, std::chrono::seconds(60), [this] { return now_; }};
};

TEST_F(RequestHistoryTest, RecognisesARepeatedRequest) {
  EXPECT_TRUE(history_.Remember("a"));
  EXPECT_TRUE(history_.Remember("b"));
  EXPECT_FALSE(history_.Remember("a"));
  EXPECT_FALSE(history_.Remember("b"));
}

TEST_F(RequestHistoryTest, RemovesTheOldestRequestIfItIsFull) {
  for (const char* id : {"a", "b", "c", "d"}) EXPECT_TRUE(history_.Remember(id));
  for (const char* id : {"b", "c", "d"}) EXPECT_FALSE(history_.Remember(id)) << id;
  EXPECT_TRUE(history_.Remember("a"));
}

TEST_F(RequestHistoryTest, RemovesRequestsAfterTheirLifetime) {
  EXPECT_TRUE(history_.Remember("a"));
  now_ += std::chrono::seconds(60);
  EXPECT_FALSE(history_.Remember("a"));
  now_ += std::chrono::seconds(1);
  EXPECT_TRUE(history_.Remember("a"));
}

TEST(AttributeTexts, AreReadBackUnchanged) {
  TraderAttributes attributes{.def_search_card = 1,
                              .max_search_card = 4'000'000'000,
                              .def_follow_policy = FollowOption::kLocalOnly,
                              .supports_dynamic_properties = false,
                              .request_id_stem = std::string("\0\xFF", 2)};
  TraderAttributes read;
  for (const auto& [name, text] : AttributeTexts(attributes)) SetAttribute(name, text, read);
  EXPECT_EQ(AttributeTexts(read), AttributeTexts(attributes));
  EXPECT_EQ(read.max_search_card, 4'000'000'000);
  EXPECT_EQ(read.request_id_stem, attributes.request_id_stem);
  EXPECT_FALSE(read.supports_dynamic_properties);
}

TEST(AttributeTexts, IgnoreInvalidValues) {
  TraderAttributes read;
  SetAttribute("max_list", "many", read);
  SetAttribute("max_list", "5000000000", read);
  SetAttribute("def_follow_policy", "3", read);
  SetAttribute("supports_dynamic_properties", "2", read);
  SetAttribute("of_a_later_version", "1", read);
  EXPECT_EQ(AttributeTexts(read), AttributeTexts({}));
}

}  // namespace
}  // namespace gsv::broker
