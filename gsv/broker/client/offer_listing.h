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
  std::string type;
  std::string interface_id;  // the type id in the service's reference
  std::string address;       // "host:port" of the service; empty when it has none on TCP
  std::string reference;     // "IOR:…"
  PropertyList properties;
};

// All offers of the broker at `broker`, in the order of export. The call uses the process's ORB,
// and starts one if there is none.
// Errors  see BrokerClient.
[[nodiscard]] base::Result<std::vector<OfferDescription>> ListOffers(
    const std::string& broker, std::chrono::milliseconds timeout = std::chrono::seconds(5));
// All service types, each with its inherited properties.
[[nodiscard]] base::Result<std::vector<ServiceType>> ListServiceTypes(
    const std::string& broker, std::chrono::milliseconds timeout = std::chrono::seconds(5));

// Prints a few lines for each offer.
void PrintOffers(const std::vector<OfferDescription>& offers, std::ostream& out);
void PrintServiceTypes(const std::vector<ServiceType>& types, std::ostream& out);

// NDJSON: one {"id":…, "type":…, "address":…, "interface":…, "properties":{name: value, …}} a line.
// A value that JSON cannot hold is {"type": its IDL type}; a dynamic one is {"dynamic": the type of
// its value}. U+FFFD replaces bytes that are not UTF-8.
void PrintOffersJson(const std::vector<OfferDescription>& offers, std::ostream& out);
// NDJSON: one {"name":…, "interface":…, "super_types":[…], "masked":…, "incarnation":…,
//  "properties":[{"name":…, "type":…, "readonly":…, "mandatory":…}, …]} a line.
void PrintServiceTypesJson(const std::vector<ServiceType>& types, std::ostream& out);

}  // namespace gsv::broker
