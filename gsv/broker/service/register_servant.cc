#include "gsv/broker/service/register_servant.h"

#include "gsv/broker/encoding/corba_values.h"
#include "gsv/broker/language/names.h"
#include "gsv/broker/service/interface_check.h"
#include "gsv/broker/service/link_servant.h"
#include "gsv/broker/service/raise.h"
#include "gsv/broker/trader/service_reference.h"
#include "gsv/broker/transport/memory_reserve.h"

namespace gsv::broker {
namespace {

// Checks that the service has the interface of the service type. If the service cannot be called to
// check it, the reference counts as invalid, because the standard has no exception for this case.
void CheckService(CORBA::Object_ptr reference, const std::string& ior, const ServiceType& type) {
  if (type.interface_name.empty()) return;
  const auto parts = ReadReference(ior);
  const std::string type_id = parts ? parts->type_id : std::string();
  switch (CheckInterface(reference, type_id, type.interface_name)) {
    case Conformance::kConforms:
      return;
    case Conformance::kDiffers:
      throw CosTrading::Register::InterfaceTypeMismatch(type.name.c_str(), reference);
    case Conformance::kUnknown:
      throw CosTrading::Register::InvalidObjectRef(reference);
  }
}

}  // namespace

char* RegisterServant::_cxx_export(CORBA::Object_ptr reference, const char* type,
                                   const CosTrading::PropertySeq& properties) {
  RequireMemoryReserve();
  if (CORBA::is_nil(reference)) throw CosTrading::Register::InvalidObjectRef(reference);
  const ServiceType service_type = ValueOrRaise(objects_.trader.TypeForExport(type));
  const CORBA::String_var ior = objects_.orb->object_to_string(reference);
  CheckService(reference, ior.in(), service_type);
  const std::string id =
      ValueOrRaise(objects_.trader.Export(service_type, ior.in(), ToProperties(properties)));
  return CORBA::string_dup(id.c_str());
}

void RegisterServant::withdraw(const char* id) { ValueOrRaise(objects_.trader.Withdraw(id)); }

CosTrading::Register::OfferInfo* RegisterServant::describe(const char* id) {
  const OfferPtr offer = ValueOrRaise(objects_.trader.Describe(id));
  CosTrading::Register::OfferInfo_var info = new CosTrading::Register::OfferInfo;
  info->reference = objects_.orb->string_to_object(offer->reference.c_str());
  info->type = offer->type->c_str();
  FillProperties(offer->properties, info->properties);
  return info._retn();
}

void RegisterServant::modify(const char* id, const CosTrading::PropertyNameSeq& del_list,
                             const CosTrading::PropertySeq& modify_list) {
  RequireMemoryReserve();
  Modification modification;
  for (CORBA::ULong i = 0; i < del_list.length(); ++i) {
    modification.remove.emplace_back(del_list[i]);
  }
  modification.set = ToProperties(modify_list);
  ValueOrRaise(objects_.trader.Modify(id, std::move(modification)));
}

void RegisterServant::withdraw_using_constraint(const char* type, const char* constr) {
  ValueOrRaise(objects_.trader.WithdrawMatching(type, constr, &objects_.dynamic));
}

// The first name is the name of a link. The trader at the end of this link resolves the other
// names.
CosTrading::Register_ptr RegisterServant::resolve(const CosTrading::TraderName& name) {
  bool legal = name.length() > 0;
  for (CORBA::ULong i = 0; i < name.length(); ++i) {
    legal = legal && IsIdentifier(static_cast<const char*>(name[i]));
  }
  const FederationLimits& limits = objects_.trader.limits().federation;
  if (!legal || name.length() > limits.trader_name) {
    throw CosTrading::Register::IllegalTraderName(name);
  }
  const auto link = objects_.trader.DescribeLink(static_cast<const char*>(name[0]));
  if (!link) throw CosTrading::Register::UnknownTraderName(name);
  const CosTrading::Register_var next = RegisterOf(objects_.orb, link->target);
  if (CORBA::is_nil(next)) throw CosTrading::Register::RegisterNotSupported(name);
  if (name.length() == 1) return CosTrading::Register::_duplicate(next);
  CosTrading::TraderName rest;
  rest.length(name.length() - 1);
  for (CORBA::ULong i = 1; i < name.length(); ++i) rest[i - 1] = name[i];
  try {
    // Each trader on the way has less time than the previous trader.
    omniORB::setClientCallTimeout(
        next, static_cast<unsigned long>((2 * limits.per_hop * rest.length()).count()));
    return next->resolve(rest);
  } catch (const CORBA::SystemException&) {
    throw CosTrading::Register::RegisterNotSupported(name);
  }
}

}  // namespace gsv::broker
