#include "gsv/broker/service/raise.h"

#include <COS/CosTrading.hh>
#include <COS/CosTradingRepos.hh>

#include "gsv/base/check.h"
#include "gsv/broker/encoding/corba_values.h"

namespace gsv::broker {
namespace {

using Repository = CosTradingRepos::ServiceTypeRepository;
using Register = CosTrading::Register;

[[noreturn]] void RaiseMismatch(const TradingError& error) {
  GSV_CHECK(error.property.has_value());
  throw CosTrading::PropertyTypeMismatch(error.type.c_str(), ToCorba(*error.property));
}

[[noreturn]] void RaiseRedefinition(const TradingError& error) {
  GSV_CHECK(error.redefinition.has_value());
  const Redefinition& r = *error.redefinition;
  throw Repository::ValueTypeRedefinition(r.type_1.c_str(), ToCorba(r.definition_1),
                                          r.type_2.c_str(), ToCorba(r.definition_2));
}

[[noreturn]] void RaiseInterfaceMismatch(const TradingError& error) {
  GSV_CHECK(error.interfaces.has_value());
  const InterfaceMismatch& m = *error.interfaces;
  throw Repository::InterfaceTypeMismatch(m.base_service.c_str(), m.base_interface.c_str(),
                                          m.derived_service.c_str(), m.derived_interface.c_str());
}

[[noreturn]] void RaiseTooPermissive(const TradingError& error) {
  GSV_CHECK(error.follow.has_value());
  const auto rule = static_cast<CosTrading::FollowOption>(error.follow->rule);
  const auto bound = static_cast<CosTrading::FollowOption>(error.follow->bound);
  if (error.refusal == Refusal::kDefaultFollowTooPermissive) {
    throw CosTrading::Link::DefaultFollowTooPermissive(rule, bound);
  }
  throw CosTrading::Link::LimitingFollowTooPermissive(rule, bound);
}

}  // namespace

void Raise(const TradingError& error) {
  const char* type = error.type.c_str();
  const char* name = error.name.c_str();
  switch (error.refusal) {
    case Refusal::kIllegalServiceType:
      throw CosTrading::IllegalServiceType(type);
    case Refusal::kUnknownServiceType:
      throw CosTrading::UnknownServiceType(type);
    case Refusal::kServiceTypeExists:
      throw Repository::ServiceTypeExists(type);
    case Refusal::kDuplicateServiceTypeName:
      throw Repository::DuplicateServiceTypeName(type);
    case Refusal::kAlreadyMasked:
      throw Repository::AlreadyMasked(type);
    case Refusal::kNotMasked:
      throw Repository::NotMasked(type);
    case Refusal::kHasSubTypes:
      throw Repository::HasSubTypes(type, name);
    case Refusal::kIllegalPropertyName:
      throw CosTrading::IllegalPropertyName(name);
    case Refusal::kDuplicatePropertyName:
      throw CosTrading::DuplicatePropertyName(name);
    case Refusal::kUnknownPropertyName:
      throw Register::UnknownPropertyName(name);
    case Refusal::kIllegalOfferId:
      throw CosTrading::IllegalOfferId(name);
    case Refusal::kUnknownOfferId:
      throw CosTrading::UnknownOfferId(name);
    case Refusal::kProxyOfferId:
      throw Register::ProxyOfferId(name);
    case Refusal::kNotProxyOfferId:
      throw CosTrading::Proxy::NotProxyOfferId(name);
    case Refusal::kMissingMandatoryProperty:
      throw CosTrading::MissingMandatoryProperty(type, name);
    case Refusal::kMandatoryProperty:
      throw Register::MandatoryProperty(type, name);
    case Refusal::kReadonlyProperty:
      throw Register::ReadonlyProperty(type, name);
    case Refusal::kReadonlyDynamicProperty:
      throw CosTrading::ReadonlyDynamicProperty(type, name);
    case Refusal::kPropertyTypeMismatch:
      RaiseMismatch(error);
    case Refusal::kIllegalConstraint:
      throw CosTrading::IllegalConstraint(name);
    case Refusal::kIllegalPreference:
      throw CosTrading::Lookup::IllegalPreference(name);
    case Refusal::kIllegalRecipe:
      throw CosTrading::Proxy::IllegalRecipe(name);
    case Refusal::kNoMatchingOffers:
      throw Register::NoMatchingOffers(name);
    case Refusal::kIllegalLinkName:
      throw CosTrading::Link::IllegalLinkName(name);
    case Refusal::kUnknownLinkName:
      throw CosTrading::Link::UnknownLinkName(name);
    case Refusal::kDuplicateLinkName:
      throw CosTrading::Link::DuplicateLinkName(name);
    case Refusal::kDefaultFollowTooPermissive:
    case Refusal::kLimitingFollowTooPermissive:
      RaiseTooPermissive(error);
    case Refusal::kValueTypeRedefinition:
      RaiseRedefinition(error);
    case Refusal::kInterfaceTypeMismatch:
      RaiseInterfaceMismatch(error);
    case Refusal::kNotImplemented:
      throw CosTrading::NotImplemented();
    case Refusal::kNotStored:
      throw CORBA::PERSIST_STORE(0, CORBA::COMPLETED_MAYBE);
    case Refusal::kLimit:
      break;
  }
  throw CORBA::IMP_LIMIT(0, CORBA::COMPLETED_NO);
}

}  // namespace gsv::broker
