// Lists a broker's offers and service types, for `gsv offers` and `gsv types`.
#pragma once

#include <chrono>
#include <iosfwd>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/broker/language/property.h"
#include "gsv/broker/offers/service_type.h"

namespace gsv::broker {

struct OfferDescription {
  std::string id;
  std::string type;          // name of the service type
  std::string interface_id;  // the type id in the reference of the service
  std::string address;    // "host:port" of the service; empty if its reference has no TCP address
  std::string reference;  // the reference, "IOR:…"
  PropertyList properties;
};

// Returns all offers of the broker at `broker`, in the order of export. The call uses the process's
// ORB, and starts one if there is none.
// Errors  see BrokerClient.
[[nodiscard]] base::Result<std::vector<OfferDescription>> ListOffers(
    const std::string& broker, std::chrono::milliseconds timeout = std::chrono::seconds(5));
// Returns all service types, each with its inherited properties.
[[nodiscard]] base::Result<std::vector<ServiceType>> ListServiceTypes(
    const std::string& broker, std::chrono::milliseconds timeout = std::chrono::seconds(5));

// Prints a few lines for each offer.
void PrintOffers(const std::vector<OfferDescription>& offers, std::ostream& out);
void PrintServiceTypes(const std::vector<ServiceType>& types, std::ostream& out);

// Prints one JSON object per line (NDJSON): {"id":…, "type":…, "address":…, "interface":…,
// "properties":{name: value, …}}. A value that JSON cannot represent is {"type": its IDL type}. A
// dynamic value is {"dynamic": the type of its value}. U+FFFD replaces bytes that are not UTF-8.
void PrintOffersJson(const std::vector<OfferDescription>& offers, std::ostream& out);
// Prints one JSON object per line (NDJSON): {"name":…, "interface":…, "super_types":[…],
// "masked":…, "incarnation":…,
//  "properties":[{"name":…, "type":…, "readonly":…, "mandatory":…}, …]}.
void PrintServiceTypesJson(const std::vector<ServiceType>& types, std::ostream& out);

}  // namespace gsv::broker
