// Implements the CORBA interface CosTrading::Proxy: exports and withdraws proxy offers, which stand
// for the offers of another trader.
#pragma once

#include <COS/CosTrading.hh>

#include "gsv/broker/service/attribute_servants.h"

namespace gsv::broker {

class ProxyServant : public POA_CosTrading::Proxy, public ComponentsServant, public SupportServant {
 public:
  explicit ProxyServant(TradingObjects& objects)
      : ComponentsServant(objects), SupportServant(objects) {}

  char* export_proxy(CosTrading::Lookup_ptr target, const char* type,
                     const CosTrading::PropertySeq& properties, CORBA::Boolean if_match_all,
                     const char* recipe, const CosTrading::PolicySeq& policies_to_pass_on) override;
  void withdraw_proxy(const char* id) override;
  CosTrading::Proxy::ProxyInfo* describe_proxy(const char* id) override;
};

}  // namespace gsv::broker
