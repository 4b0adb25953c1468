#include "gsv/broker/service/link_servant.h"

#include "gsv/broker/service/interface_check.h"
#include "gsv/broker/service/policy_values.h"
#include "gsv/broker/service/raise.h"
#include "gsv/broker/trader/service_reference.h"
#include "gsv/broker/transport/memory_reserve.h"

namespace gsv::broker {
namespace {

constexpr unsigned long kCallTimeoutMs = 1000;

}  // namespace

CosTrading::Register_ptr RegisterOf(CORBA::ORB_ptr orb, const std::string& target) {
  try {
    const CORBA::Object_var object = orb->string_to_object(target.c_str());
    const CosTrading::Lookup_var lookup = CosTrading::Lookup::_unchecked_narrow(object);
    omniORB::setClientCallTimeout(lookup, kCallTimeoutMs);
    return lookup->register_if();
  } catch (const CORBA::SystemException&) {
    return CosTrading::Register::_nil();
  }
}

std::string CheckLookup(CORBA::ORB_ptr orb, CosTrading::Lookup_ptr target) {
  if (CORBA::is_nil(target)) throw CosTrading::InvalidLookupRef(target);
  const CORBA::String_var ior = orb->object_to_string(target);
  const auto parts = ReadReference(ior.in());
  const std::string type_id = parts ? parts->type_id : std::string();
  if (CheckInterface(target, type_id, CosTrading::Lookup::_PD_repoId) != Conformance::kConforms) {
    throw CosTrading::InvalidLookupRef(target);
  }
  return ior.in();
}

CosTrading::FollowOption LinkServant::max_link_follow_policy() {
  return ToCorba(objects_.trader.attributes().max_link_follow_policy);
}

void LinkServant::add_link(const char* name, CosTrading::Lookup_ptr target,
                           CosTrading::FollowOption def_pass_on_follow_rule,
                           CosTrading::FollowOption limiting_follow_rule) {
  RequireMemoryReserve();
  ValueOrRaise(objects_.trader.AddLink({.name = name,
                                        .target = CheckLookup(objects_.orb, target),
                                        .def_pass_on = FromCorba(def_pass_on_follow_rule),
                                        .limiting = FromCorba(limiting_follow_rule)}));
}

void LinkServant::remove_link(const char* name) { ValueOrRaise(objects_.trader.RemoveLink(name)); }

CosTrading::Link::LinkInfo* LinkServant::describe_link(const char* name) {
  const TraderLink link = ValueOrRaise(objects_.trader.DescribeLink(name));
  CosTrading::Link::LinkInfo_var info = new CosTrading::Link::LinkInfo;
  const CORBA::Object_var target = objects_.orb->string_to_object(link.target.c_str());
  info->target = CosTrading::Lookup::_unchecked_narrow(target);
  info->target_reg = RegisterOf(objects_.orb, link.target);
  info->def_pass_on_follow_rule = ToCorba(link.def_pass_on);
  info->limiting_follow_rule = ToCorba(link.limiting);
  return info._retn();
}

CosTrading::LinkNameSeq* LinkServant::list_links() {
  const std::vector<TraderLink> links = objects_.trader.links();
  CosTrading::LinkNameSeq_var names = new CosTrading::LinkNameSeq;
  names->length(static_cast<CORBA::ULong>(links.size()));
  for (CORBA::ULong i = 0; i < links.size(); ++i) names[i] = links[i].name.c_str();
  return names._retn();
}

void LinkServant::modify_link(const char* name, CosTrading::FollowOption def_pass_on_follow_rule,
                              CosTrading::FollowOption limiting_follow_rule) {
  ValueOrRaise(objects_.trader.ModifyLink(name, FromCorba(def_pass_on_follow_rule),
                                          FromCorba(limiting_follow_rule)));
}

}  // namespace gsv::broker
