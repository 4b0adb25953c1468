#include "gsv/broker/policy_values.h"

#include <set>
#include <string>
#include <string_view>

#include "gsv/broker/names.h"

namespace gsv::broker {
namespace {

using CosTrading::Lookup;

template <typename T>
T Extract(const CosTrading::Policy& policy) {
  T value{};
  if (!(policy.value >>= value)) throw Lookup::PolicyTypeMismatch(policy);
  return value;
}

bool ExtractBoolean(const CosTrading::Policy& policy) {
  CORBA::Boolean value = false;
  if (!(policy.value >>= CORBA::Any::to_boolean(value))) throw Lookup::PolicyTypeMismatch(policy);
  return value;
}

// This trader has no links: only the empty name, which is this trader, leads anywhere.
void CheckStartingTrader(const CosTrading::Policy& policy) {
  const CosTrading::TraderName* name = nullptr;
  if (!(policy.value >>= name)) throw Lookup::PolicyTypeMismatch(policy);
  if (name->length() > 0) throw Lookup::InvalidPolicyValue(policy);
}

void CheckRequestId(const CosTrading::Policy& policy) {
  const CosTrading::Admin::OctetSeq* id = nullptr;
  if (!(policy.value >>= id)) throw Lookup::PolicyTypeMismatch(policy);
}

void Apply(const CosTrading::Policy& policy, ImportPolicies& policies) {
  const std::string_view name = policy.name.in();
  if (name == "search_card") {
    policies.search_card = Extract<CORBA::ULong>(policy);
  } else if (name == "match_card") {
    policies.match_card = Extract<CORBA::ULong>(policy);
  } else if (name == "return_card") {
    policies.return_card = Extract<CORBA::ULong>(policy);
  } else if (name == "exact_type_match") {
    policies.exact_type_match = ExtractBoolean(policy);
  } else if (name == "use_modifiable_properties") {
    policies.use_modifiable_properties = ExtractBoolean(policy);
  } else if (name == "use_dynamic_properties") {
    policies.use_dynamic_properties = ExtractBoolean(policy);
  } else if (name == "use_proxy_offers") {
    ExtractBoolean(policy);  // there are none to leave out
  } else if (name == "hop_count") {
    Extract<CORBA::ULong>(policy);  // there are no links to follow
  } else if (name == "link_follow_rule") {
    Extract<CosTrading::FollowOption>(policy);
  } else if (name == "starting_trader") {
    CheckStartingTrader(policy);
  } else if (name == "request_id") {
    CheckRequestId(policy);
  }
}

}  // namespace

ImportPolicies ToImportPolicies(const CosTrading::PolicySeq& policies) {
  ImportPolicies result;
  std::set<std::string> seen;
  for (CORBA::ULong i = 0; i < policies.length(); ++i) {
    const char* name = policies[i].name.in();
    if (!IsIdentifier(name)) throw Lookup::IllegalPolicyName(name);
    if (!seen.insert(name).second) throw CosTrading::DuplicatePolicyName(name);
    Apply(policies[i], result);
  }
  return result;
}

}  // namespace gsv::broker
