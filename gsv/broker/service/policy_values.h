// Converts the policies of a query from and to CORBA.
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

// Reads the policies. Ignores a policy with a name that the standard does not define.
// Errors  throws IllegalPolicyName, DuplicatePolicyName, PolicyTypeMismatch, InvalidPolicyValue.
ImportPolicies ToImportPolicies(const CosTrading::PolicySeq& policies);

// The policies that replace the importer's policies when the query is forwarded to another trader.
// An absent policy keeps the importer's value, except starting_trader, which is removed.
struct PassedPolicies {
  TraderName starting_trader{};
  std::optional<std::uint32_t> hop_count{};
  std::optional<FollowOption> link_follow_rule{};
  std::optional<std::string> request_id{};
  // Policies that replace the importer's policies with the same names. A member above that has a
  // value takes precedence over a fixed policy with its name.
  CosTrading::PolicySeq fixed{};
};

// Returns the policies for another trader. starting_trader comes first in them, as the standard
// recommends, and passed.fixed comes last.
CosTrading::PolicySeq PoliciesToPassOn(const CosTrading::PolicySeq& policies,
                                       const PassedPolicies& passed);

}  // namespace gsv::broker
