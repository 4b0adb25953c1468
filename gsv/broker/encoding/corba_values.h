// Converts properties and their types between CORBA and the trader.
//
// A value that the constraint language can handle becomes plain data, and aliases of its type are
// resolved. Every other value keeps its encoding.
#pragma once

#include <string>

#include <COS/CosTrading.hh>
#include <COS/CosTradingRepos.hh>

#include "gsv/broker/encoding/corba_types.h"
#include "gsv/broker/language/property.h"
#include "gsv/broker/offers/service_type.h"

namespace gsv::broker {

// Errors  throws CORBA::MARSHAL for a value that its TypeCode does not describe.
Value ToValue(const CORBA::Any& any);
CORBA::Any ToAny(const Value& value);

std::vector<Property> ToProperties(const CosTrading::PropertySeq& properties);
CosTrading::Property ToCorba(const Property& property);
void FillProperty(const std::string& name, const Value& value, CosTrading::Property& property);
void FillProperties(const PropertyList& list, CosTrading::PropertySeq& properties);

CosTradingRepos::ServiceTypeRepository::PropStruct ToCorba(const PropertyDefinition& definition);
PropertyDefinition ToDefinition(const CosTradingRepos::ServiceTypeRepository::PropStruct& prop);

CosTradingRepos::ServiceTypeRepository::TypeStruct ToCorba(const ServiceType& type);
ServiceType ToServiceType(std::string name,
                          const CosTradingRepos::ServiceTypeRepository::TypeStruct& description);

CosTradingRepos::ServiceTypeRepository::IncarnationNumber ToIncarnation(std::uint64_t number);
std::uint64_t FromIncarnation(
    const CosTradingRepos::ServiceTypeRepository::IncarnationNumber& number);

}  // namespace gsv::broker
