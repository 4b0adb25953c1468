// What `gsv offers` and `gsv types` show.
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

// Everything that the broker at `broker` offers, in the order of export. They use the process's
// ORB, and start one if there is none.
// Errors  see BrokerClient.
[[nodiscard]] base::Result<std::vector<OfferDescription>> ListOffers(
    const std::string& broker, std::chrono::milliseconds timeout = std::chrono::seconds(5));
// With every inherited property.
[[nodiscard]] base::Result<std::vector<ServiceType>> ListServiceTypes(
    const std::string& broker, std::chrono::milliseconds timeout = std::chrono::seconds(5));

// For people: a few lines an offer.
void PrintOffers(const std::vector<OfferDescription>& offers, std::ostream& out);
void PrintServiceTypes(const std::vector<ServiceType>& types, std::ostream& out);

// NDJSON: {"id":…, "type":…, "address":…, "interface":…, "properties":{name: value, …}} a line. A
// value that JSON cannot hold is {"type": its IDL type}, a dynamic one {"dynamic": the type that it
// will have}; text that is not UTF-8 is mended with U+FFFD.
void PrintOffersJson(const std::vector<OfferDescription>& offers, std::ostream& out);
// {"name":…, "interface":…, "super_types":[…], "masked":…, "incarnation":…,
//  "properties":[{"name":…, "type":…, "readonly":…, "mandatory":…}, …]} a line.
void PrintServiceTypesJson(const std::vector<ServiceType>& types, std::ostream& out);

}  // namespace gsv::broker
