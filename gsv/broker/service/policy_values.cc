#include "gsv/broker/service/policy_values.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "gsv/broker/language/names.h"

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

constexpr CORBA::ULong kMaxRequestIdLength = 1024;

// Whether a type is FollowOption except for its repository identifier, which an ORB may omit.
bool IsAnonymousFollowOption(CORBA::TypeCode_ptr type) {
  if (type->kind() != CORBA::tk_enum || *type->id() != '\0' || type->member_count() != 3) {
    return false;
  }
  for (CORBA::ULong i = 0; i < 3; ++i) {
    if (std::string_view(type->member_name(i)) != CosTrading::_tc_FollowOption->member_name(i)) {
      return false;
    }
  }
  return true;
}

FollowOption ExtractFollowOption(const CosTrading::Policy& policy) {
  const CORBA::TypeCode_var type = policy.value.type();
  if (!IsAnonymousFollowOption(type)) {
    return FromCorba(Extract<CosTrading::FollowOption>(policy));
  }
  cdrMemoryStream stream;
  policy.value.NP_marshalDataOnly(stream);
  CORBA::ULong value = 0;
  value <<= stream;
  if (value > static_cast<CORBA::ULong>(FollowOption::kAlways)) {
    throw Lookup::InvalidPolicyValue(policy);
  }
  return static_cast<FollowOption>(value);
}

TraderName ExtractTraderName(const CosTrading::Policy& policy) {
  const CosTrading::TraderName* name = nullptr;
  if (!(policy.value >>= name)) throw Lookup::PolicyTypeMismatch(policy);
  TraderName result;
  for (CORBA::ULong i = 0; i < name->length(); ++i) result.emplace_back((*name)[i]);
  return result;
}

std::string ExtractRequestId(const CosTrading::Policy& policy) {
  const CosTrading::Admin::OctetSeq* id = nullptr;
  if (!(policy.value >>= id)) throw Lookup::PolicyTypeMismatch(policy);
  if (id->length() > kMaxRequestIdLength) throw Lookup::InvalidPolicyValue(policy);
  return {reinterpret_cast<const char*>(id->get_buffer()), id->length()};
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
    policies.use_proxy_offers = ExtractBoolean(policy);
  } else if (name == "hop_count") {
    policies.hop_count = Extract<CORBA::ULong>(policy);
  } else if (name == "link_follow_rule") {
    policies.link_follow_rule = ExtractFollowOption(policy);
  } else if (name == "starting_trader") {
    policies.starting_trader = ExtractTraderName(policy);
  } else if (name == "request_id") {
    policies.request_id = ExtractRequestId(policy);
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

CosTrading::PolicySeq PoliciesToPassOn(const CosTrading::PolicySeq& policies,
                                       const PassedPolicies& passed) {
  CosTrading::PolicySeq result;
  const auto add = [&](const char* name, const CORBA::Any& value) {
    const CORBA::ULong count = result.length();
    result.length(count + 1);
    result[count].name = name;
    result[count].value = value;
  };
  if (!passed.starting_trader.empty()) {
    CosTrading::TraderName name;
    name.length(static_cast<CORBA::ULong>(passed.starting_trader.size()));
    for (CORBA::ULong i = 0; i < name.length(); ++i) name[i] = passed.starting_trader[i].c_str();
    CORBA::Any value;
    value <<= name;
    add("starting_trader", value);
  }
  if (passed.hop_count) {
    CORBA::Any value;
    value <<= CORBA::ULong{*passed.hop_count};
    add("hop_count", value);
  }
  if (passed.link_follow_rule) {
    CORBA::Any value;
    value <<= ToCorba(*passed.link_follow_rule);
    add("link_follow_rule", value);
  }
  if (passed.request_id) {
    CosTrading::Admin::OctetSeq id;
    id.length(static_cast<CORBA::ULong>(passed.request_id->size()));
    std::copy(passed.request_id->begin(), passed.request_id->end(), id.get_buffer());
    CORBA::Any value;
    value <<= id;
    add("request_id", value);
  }
  std::set<std::string> taken = {"starting_trader"};
  for (CORBA::ULong i = 0; i < result.length(); ++i) taken.insert(result[i].name.in());
  const std::set<std::string> set_here = taken;
  for (CORBA::ULong i = 0; i < passed.fixed.length(); ++i) {
    taken.insert(passed.fixed[i].name.in());
  }
  for (CORBA::ULong i = 0; i < policies.length(); ++i) {
    if (!taken.contains(policies[i].name.in())) add(policies[i].name, policies[i].value);
  }
  for (CORBA::ULong i = 0; i < passed.fixed.length(); ++i) {
    const CosTrading::Policy& fixed = passed.fixed[i];
    const std::string name = fixed.name.in();
    if (name == "starting_trader" || !set_here.contains(name)) add(fixed.name, fixed.value);
  }
  return result;
}

}  // namespace gsv::broker
