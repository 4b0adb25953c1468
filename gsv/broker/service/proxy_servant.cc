#include "gsv/broker/service/proxy_servant.h"

#include <set>
#include <string>

#include "gsv/broker/encoding/corba_values.h"
#include "gsv/broker/encoding/record_encoding.h"
#include "gsv/broker/service/link_servant.h"
#include "gsv/broker/service/raise.h"
#include "gsv/broker/transport/memory_reserve.h"

namespace gsv::broker {
namespace {

void CheckNames(const CosTrading::PolicySeq& policies) {
  std::set<std::string> seen;
  for (CORBA::ULong i = 0; i < policies.length(); ++i) {
    const char* name = policies[i].name;
    if (!seen.insert(name).second) throw CosTrading::DuplicatePolicyName(name);
  }
}

}  // namespace

char* ProxyServant::export_proxy(CosTrading::Lookup_ptr target, const char* type,
                                 const CosTrading::PropertySeq& properties,
                                 CORBA::Boolean if_match_all, const char* recipe,
                                 const CosTrading::PolicySeq& policies_to_pass_on) {
  RequireMemoryReserve();
  ValueOrRaise(objects_.trader.TypeForExport(type));
  const std::string ior = CheckLookup(objects_.orb, target);
  CheckNames(policies_to_pass_on);
  const std::string id =
      ValueOrRaise(objects_.trader.ExportProxy(type, ior, ToProperties(properties),
                                               {.if_match_all = if_match_all,
                                                .recipe = recipe,
                                                .policies = EncodePolicies(policies_to_pass_on)}));
  return CORBA::string_dup(id.c_str());
}

void ProxyServant::withdraw_proxy(const char* id) {
  ValueOrRaise(objects_.trader.WithdrawProxy(id));
}

CosTrading::Proxy::ProxyInfo* ProxyServant::describe_proxy(const char* id) {
  const OfferPtr offer = ValueOrRaise(objects_.trader.DescribeProxy(id));
  CosTrading::Proxy::ProxyInfo_var info = new CosTrading::Proxy::ProxyInfo;
  info->type = offer->type->c_str();
  const CORBA::Object_var target = objects_.orb->string_to_object(offer->reference.c_str());
  info->target = CosTrading::Lookup::_unchecked_narrow(target);
  FillProperties(offer->properties, info->properties);
  info->if_match_all = offer->proxy->if_match_all;
  info->recipe = offer->proxy->recipe.c_str();
  if (const auto policies = DecodePolicies(offer->proxy->policies)) {
    info->policies_to_pass_on = *policies;
  }
  return info._retn();
}

}  // namespace gsv::broker
