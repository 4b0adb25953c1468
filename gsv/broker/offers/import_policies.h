// Limits of a query: the policies of the importer, and the attributes of the trader.
//
// Source  OMG Trading Object Service (formal/00-06-27), "policies".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gsv::broker {

// As CosTrading::FollowOption.
enum class FollowOption : std::uint8_t { kLocalOnly, kIfNoLocal, kAlways };

// The names of the links on the way to another trader, in order.
using TraderName = std::vector<std::string>;

// The trader's attributes: its defaults and limits.
struct TraderAttributes {
  // Numbers of offers, see Cardinalities. `def_` is the value for a query without the policy, and
  // `max_` is the largest value that the trader applies.
  std::uint32_t def_search_card = 200'000;
  std::uint32_t max_search_card = 200'000;
  std::uint32_t def_match_card = 200'000;
  std::uint32_t max_match_card = 200'000;
  std::uint32_t def_return_card = 200'000;
  std::uint32_t max_return_card = 200'000;
  std::uint32_t max_list = 1000;  // maximum number of offers or ids in one reply
  // Maximum number of times that a query is forwarded from trader to trader.
  std::uint32_t def_hop_count = 5;
  std::uint32_t max_hop_count = 10;
  // When queries follow links: the rule of a query without the policy link_follow_rule, the most
  // permissive rule of any query, and the most permissive limiting rule of a link.
  FollowOption def_follow_policy = FollowOption::kIfNoLocal;
  FollowOption max_follow_policy = FollowOption::kAlways;
  FollowOption max_link_follow_policy = FollowOption::kAlways;
  bool supports_modifiable_properties = true;
  bool supports_dynamic_properties = true;
  bool supports_proxy_offers = true;
  std::string request_id_stem{};  // begins each request id of this trader; unique to the trader
};

// The policies of one query. For an absent policy, the trader's default applies.
struct ImportPolicies {
  // Numbers of offers, see Cardinalities.
  std::optional<std::uint32_t> search_card{};
  std::optional<std::uint32_t> match_card{};
  std::optional<std::uint32_t> return_card{};
  bool exact_type_match = false;  // whether offers of sub types are ignored
  // One member for each kind of offers: offers with properties that can be modified, offers with
  // dynamic properties, and proxy offers. If it is false, the query ignores these offers.
  bool use_modifiable_properties = true;
  bool use_dynamic_properties = true;
  bool use_proxy_offers = true;
  std::optional<std::uint32_t> hop_count{};  // how many times the query may be forwarded
  std::optional<FollowOption> link_follow_rule{};
  TraderName starting_trader{};  // the trader that is to answer; empty for this trader
  // The unique id of a query from another trader.
  std::optional<std::string> request_id{};
};

// The maximum number of offers that a query examines, orders and returns.
struct Cardinalities {
  std::uint32_t search = 0;    // offers that the query examines
  std::uint32_t match = 0;     // matching offers that are ordered by the preference
  std::uint32_t returned = 0;  // offers in the result
};

// Returns each policy or its default, but at most the trader's maximum.
Cardinalities EffectiveCardinalities(const ImportPolicies& policies,
                                     const TraderAttributes& attributes);

}  // namespace gsv::broker
