// Implements the attributes that the trader's interfaces have in common.
#pragma once

#include <COS/CosTrading.hh>

#include "gsv/broker/service/trading_objects.h"

namespace gsv::broker {

// Implements the attributes for the references of the trader's interfaces.
class ComponentsServant : public virtual POA_CosTrading::TraderComponents {
 public:
  CosTrading::Lookup_ptr lookup_if() override;
  CosTrading::Register_ptr register_if() override;
  CosTrading::Link_ptr link_if() override;
  CosTrading::Proxy_ptr proxy_if() override;
  CosTrading::Admin_ptr admin_if() override;

 protected:
  explicit ComponentsServant(TradingObjects& objects) : objects_(objects) {}
  TradingObjects& objects_;  // the trader, its cursors, and the references of its interfaces
};

// Implements the attributes for the trader's optional features and its type repository.
class SupportServant : public virtual POA_CosTrading::SupportAttributes {
 public:
  CORBA::Boolean supports_modifiable_properties() override;
  CORBA::Boolean supports_dynamic_properties() override;
  CORBA::Boolean supports_proxy_offers() override;
  CORBA::Object_ptr type_repos() override;

 protected:
  explicit SupportServant(TradingObjects& objects) : trading_(objects) {}

 private:
  TradingObjects& trading_;  // the trader, and the reference of its type repository
};

// Implements the attributes for the limits of queries.
class ImportServant : public virtual POA_CosTrading::ImportAttributes {
 public:
  CORBA::ULong def_search_card() override;
  CORBA::ULong max_search_card() override;
  CORBA::ULong def_match_card() override;
  CORBA::ULong max_match_card() override;
  CORBA::ULong def_return_card() override;
  CORBA::ULong max_return_card() override;
  CORBA::ULong max_list() override;
  CORBA::ULong def_hop_count() override;
  CORBA::ULong max_hop_count() override;
  CosTrading::FollowOption def_follow_policy() override;
  CosTrading::FollowOption max_follow_policy() override;

 protected:
  explicit ImportServant(const Trader& trader) : trader_(trader) {}

 private:
  const Trader& trader_;  // the trader whose attributes are returned
};

}  // namespace gsv::broker
