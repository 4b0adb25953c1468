// A client of a broker: registers service types, exports offers and finds them.
//
// It works with any Trading Service. Every call ends within the time-out. Every failure is an Error
// whose sentence names the broker's address.
//
// Errors   kInvalidArgument: a wrong argument (for a constraint, with the position of the error).
//          kNotFound: no such service type, offer or property. kUnavailable, kTimeout: no response
//          from the address, or not in time.
// Threads  every member may be called at any time.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include <COS/CosTrading.hh>
#include <COS/CosTradingRepos.hh>

#include "gsv/base/error.h"
#include "gsv/broker/language/property.h"
#include "gsv/broker/offers/service_type.h"

namespace gsv::broker {

struct FoundOffer {
  CORBA::Object_var object;
  PropertyList properties;
};

// An offer as its broker knows it.
struct DescribedOffer {
  std::string id;
  std::string type;
  CORBA::Object_var object;
  PropertyList properties;
};

class BrokerClient {
 public:
  // `reference`: "corbaloc::host:port/TradingService" ("1.2@" is added if it is missing), an
  // "IOR:…", or empty for the value of omniORB's -ORBInitRef TradingService=….
  [[nodiscard]] static base::Result<BrokerClient> Connect(
      CORBA::ORB_ptr orb, const std::string& reference,
      std::chrono::milliseconds timeout = std::chrono::seconds(5));

  // The broker's address, to show to users and to pass to other programs.
  const std::string& reference() const { return reference_; }

  // Adds the type. It is no error if the broker already has an equal type.
  [[nodiscard]] base::Status EnsureServiceType(const ServiceType& type);
  // Returns the offer's id. Refuses a service that listens on loopback while the broker is on
  // another host, because no client there could call it.
  [[nodiscard]] base::Result<std::string> Export(const std::string& type, CORBA::Object_ptr object,
                                                 const std::vector<Property>& properties);
  [[nodiscard]] base::Status Withdraw(const std::string& id);
  // Sets `properties`; the other properties of the offer stay.
  [[nodiscard]] base::Status Modify(const std::string& id, const std::vector<Property>& properties);
  // At most `limit` offers with all their properties, in the order of `preference`.
  [[nodiscard]] base::Result<std::vector<FoundOffer>> Query(const std::string& type,
                                                            const std::string& constraint,
                                                            const std::string& preference,
                                                            std::size_t limit);

  [[nodiscard]] base::Result<std::vector<std::string>> ServiceTypeNames();
  // The type with all inherited properties.
  [[nodiscard]] base::Result<ServiceType> DescribeServiceType(const std::string& name);
  [[nodiscard]] base::Result<std::vector<std::string>> OfferIds();
  [[nodiscard]] base::Result<DescribedOffer> Describe(const std::string& id);

 private:
  BrokerClient() = default;
  base::Status Resolve(CORBA::ORB_ptr orb, unsigned long timeout_ms);

  std::string reference_;
  unsigned long timeout_ms_ = 0;
  CORBA::ORB_var orb_;
  CosTrading::Lookup_var lookup_;
  CosTrading::Register_var registry_;
  CosTrading::Admin_var admin_;  // nil if the broker has none
  CosTradingRepos::ServiceTypeRepository_var types_;
};

}  // namespace gsv::broker
