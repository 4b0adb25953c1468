// Encodes the properties of offers, and service types, as bytes that are stored in a file.
//
// Format  CDR encapsulations of CosTrading::PropertySeq and PolicySeq, and of
//         CosTradingRepos::ServiceTypeRepository::TypeStruct.
// The process needs an ORB.
//
// Errors  kCorrupt for bytes that do not have this format.
#pragma once

#include <string>

#include <COS/CosTrading.hh>

#include "gsv/base/error.h"
#include "gsv/broker/language/property.h"
#include "gsv/broker/offers/service_type.h"

namespace gsv::broker {

std::string EncodeProperties(const PropertyList& properties);
[[nodiscard]] base::Result<PropertyList> DecodeProperties(const std::string& bytes);

std::string EncodePolicies(const CosTrading::PolicySeq& policies);
[[nodiscard]] base::Result<CosTrading::PolicySeq> DecodePolicies(const std::string& bytes);

// Encodes the type without its name.
std::string EncodeServiceType(const ServiceType& type);
[[nodiscard]] base::Result<ServiceType> DecodeServiceType(const std::string& name,
                                                          const std::string& bytes);

}  // namespace gsv::broker
