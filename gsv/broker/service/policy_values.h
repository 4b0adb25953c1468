// Reads the policies of a query.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <COS/CosTrading.hh>

#include "gsv/broker/offers/import_policies.h"

namespace gsv::broker {

inline FollowOption FromCorba(CosTrading::FollowOption option) {
  return static_cast<FollowOption>(option);
}
inline CosTrading::FollowOption ToCorba(FollowOption option) {
  return static_cast<CosTrading::FollowOption>(option);
}

// A policy with a name that the standard does not know is passed over.
// Errors  throws IllegalPolicyName, DuplicatePolicyName, PolicyTypeMismatch, InvalidPolicyValue.
ImportPolicies ToImportPolicies(const CosTrading::PolicySeq& policies);

// What replaces the importer's own policies when the query goes to another trader; what is absent
// stays as the importer said it, but for starting_trader, which then goes.
struct PassedPolicies {
  TraderName starting_trader{};
  std::optional<std::uint32_t> hop_count{};
  std::optional<FollowOption> link_follow_rule{};
  std::optional<std::string> request_id{};
  // In the place of the importer's of the same names, and after all others; those above stay.
  CosTrading::PolicySeq fixed{};
};

// starting_trader first, as the standard recommends.
CosTrading::PolicySeq PoliciesToPassOn(const CosTrading::PolicySeq& policies,
                                       const PassedPolicies& passed);

}  // namespace gsv::broker
