#include "gsv/broker/service/attribute_servants.h"

#include "gsv/broker/service/policy_values.h"

namespace gsv::broker {

CosTrading::Lookup_ptr ComponentsServant::lookup_if() {
  return CosTrading::Lookup::_duplicate(objects_.lookup);
}

CosTrading::Register_ptr ComponentsServant::register_if() {
  return CosTrading::Register::_duplicate(objects_.registry);
}

CosTrading::Link_ptr ComponentsServant::link_if() {
  return CosTrading::Link::_duplicate(objects_.link);
}

CosTrading::Proxy_ptr ComponentsServant::proxy_if() {
  return CosTrading::Proxy::_duplicate(objects_.proxy);
}

CosTrading::Admin_ptr ComponentsServant::admin_if() {
  return CosTrading::Admin::_duplicate(objects_.admin);
}

CORBA::Boolean SupportServant::supports_modifiable_properties() {
  return trading_.trader.attributes().supports_modifiable_properties;
}

CORBA::Boolean SupportServant::supports_dynamic_properties() {
  return trading_.trader.attributes().supports_dynamic_properties;
}

CORBA::Boolean SupportServant::supports_proxy_offers() {
  return trading_.trader.attributes().supports_proxy_offers;
}

CORBA::Object_ptr SupportServant::type_repos() { return CORBA::Object::_duplicate(trading_.types); }

CORBA::ULong ImportServant::def_search_card() { return trader_.attributes().def_search_card; }

CORBA::ULong ImportServant::max_search_card() { return trader_.attributes().max_search_card; }

CORBA::ULong ImportServant::def_match_card() { return trader_.attributes().def_match_card; }

CORBA::ULong ImportServant::max_match_card() { return trader_.attributes().max_match_card; }

CORBA::ULong ImportServant::def_return_card() { return trader_.attributes().def_return_card; }

CORBA::ULong ImportServant::max_return_card() { return trader_.attributes().max_return_card; }

CORBA::ULong ImportServant::max_list() { return trader_.attributes().max_list; }

CORBA::ULong ImportServant::def_hop_count() { return trader_.attributes().def_hop_count; }

CORBA::ULong ImportServant::max_hop_count() { return trader_.attributes().max_hop_count; }

CosTrading::FollowOption ImportServant::def_follow_policy() {
  return ToCorba(trader_.attributes().def_follow_policy);
}

CosTrading::FollowOption ImportServant::max_follow_policy() {
  return ToCorba(trader_.attributes().max_follow_policy);
}

}  // namespace gsv::broker
