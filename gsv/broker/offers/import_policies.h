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
  std::uint32_t def_search_card = 200'000;
  std::uint32_t max_search_card = 200'000;
  std::uint32_t def_match_card = 200'000;
  std::uint32_t max_match_card = 200'000;
  std::uint32_t def_return_card = 200'000;
  std::uint32_t max_return_card = 200'000;
  std::uint32_t max_list = 1000;
  std::uint32_t def_hop_count = 5;
  std::uint32_t max_hop_count = 10;
  FollowOption def_follow_policy = FollowOption::kIfNoLocal;
  FollowOption max_follow_policy = FollowOption::kAlways;
  FollowOption max_link_follow_policy = FollowOption::kAlways;
  bool supports_modifiable_properties = true;
  bool supports_dynamic_properties = true;
  bool supports_proxy_offers = true;
  std::string request_id_stem{};  // octets that no other trader uses
};

// The policies of one query. For an absent policy, the trader's default applies.
struct ImportPolicies {
  std::optional<std::uint32_t> search_card{};
  std::optional<std::uint32_t> match_card{};
  std::optional<std::uint32_t> return_card{};
  bool exact_type_match = false;
  bool use_modifiable_properties = true;
  bool use_dynamic_properties = true;
  bool use_proxy_offers = true;
  std::optional<std::uint32_t> hop_count{};
  std::optional<FollowOption> link_follow_rule{};
  TraderName starting_trader{};
  // The unique id of a query from another trader.
  std::optional<std::string> request_id{};
};

// The maximum number of offers that a query examines, orders and returns.
struct Cardinalities {
  std::uint32_t search = 0;
  std::uint32_t match = 0;
  std::uint32_t returned = 0;
};

Cardinalities EffectiveCardinalities(const ImportPolicies& policies,
                                     const TraderAttributes& attributes);

}  // namespace gsv::broker
