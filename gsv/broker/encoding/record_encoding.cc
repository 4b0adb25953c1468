#include "gsv/broker/encoding/record_encoding.h"

#include <algorithm>
#include <set>
#include <utility>

#include "gsv/broker/encoding/corba_values.h"
#include "gsv/broker/transport/encapsulation.h"
#include "gsv/broker/transport/message_check.h"

namespace gsv::broker {
namespace {

template <typename T>
std::string Encode(const T& value) {
  cdrEncapsulationStream stream;
  value >>= stream;
  return BytesOf(stream);
}

// Returns the result of `read`, or kCorrupt if it throws omniORB's exception for bytes that cannot
// be decoded.
template <typename T, typename Read>
base::Result<T> Decode(const char* what, const Read& read) {
  try {
    return read();
  } catch (const CORBA::Exception& exception) {
    return base::Fail(base::ErrorCode::kCorrupt,
                      std::string(what) + " cannot be decoded (" + exception._name() + ")");
  }
}

bool HasDuplicates(const std::vector<Property>& properties) {
  std::set<std::string_view> names;
  return !std::all_of(properties.begin(), properties.end(),
                      [&](const Property& property) { return names.insert(property.name).second; });
}

}  // namespace

std::string EncodeProperties(const PropertyList& properties) {
  CosTrading::PropertySeq sequence;
  FillProperties(properties, sequence);
  return Encode(sequence);
}

base::Result<PropertyList> DecodeProperties(const std::string& bytes) {
  return Decode<PropertyList>("an offer", [&]() -> base::Result<PropertyList> {
    if (!IsPropertySequence(bytes)) throw CORBA::MARSHAL();
    cdrEncapsulationStream stream = StreamOf(bytes);
    CosTrading::PropertySeq sequence;
    sequence <<= stream;
    std::vector<Property> properties = ToProperties(sequence);
    if (HasDuplicates(properties)) {
      return base::Fail(base::ErrorCode::kCorrupt,
                        "an offer has two properties with the same name");
    }
    return PropertyList(std::move(properties));
  });
}

std::string EncodePolicies(const CosTrading::PolicySeq& policies) { return Encode(policies); }

base::Result<CosTrading::PolicySeq> DecodePolicies(const std::string& bytes) {
  return Decode<CosTrading::PolicySeq>("a policy", [&]() -> base::Result<CosTrading::PolicySeq> {
    if (!IsPropertySequence(bytes)) throw CORBA::MARSHAL();
    cdrEncapsulationStream stream = StreamOf(bytes);
    CosTrading::PolicySeq policies;
    policies <<= stream;
    return policies;
  });
}

std::string EncodeServiceType(const ServiceType& type) { return Encode(ToCorba(type)); }

base::Result<ServiceType> DecodeServiceType(const std::string& name, const std::string& bytes) {
  return Decode<ServiceType>("a service type", [&]() -> base::Result<ServiceType> {
    cdrEncapsulationStream stream = StreamOf(bytes);
    CosTradingRepos::ServiceTypeRepository::TypeStruct description;
    description <<= stream;
    return ToServiceType(name, description);
  });
}

}  // namespace gsv::broker
