// A client of a broker: registers service types, exports offers and finds them.
//
// It works with any Trading Service. Every call ends within the timeout. Every failure is an Error
// whose sentence names the broker's address.
//
// Errors   kInvalidArgument for a wrong argument. For a wrong constraint, the error contains the
//          position in the text. kNotFound if there is no such service type or offer.
//          kUnavailable if nothing answers at the address, kTimeout if the answer is late.
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
  CORBA::Object_var object;  // the offered service
  PropertyList properties;
};

// An offer as the broker describes it.
struct DescribedOffer {
  std::string id;
  std::string type;          // name of the service type
  CORBA::Object_var object;  // the offered service
  PropertyList properties;
};

class BrokerClient {
 public:
  // Connects to a broker. `reference` is "corbaloc::host:port/TradingService" ("1.2@" is added if
  // it is missing) or an "IOR:…". If `reference` is empty, the value of omniORB's -ORBInitRef
  // TradingService=… is used.
  [[nodiscard]] static base::Result<BrokerClient> Connect(
      CORBA::ORB_ptr orb, const std::string& reference,
      std::chrono::milliseconds timeout = std::chrono::seconds(5));

  // The broker's address, to show to users and to pass to other programs.
  const std::string& reference() const { return reference_; }

  // Adds the type. If the broker already has an equal type, this succeeds.
  [[nodiscard]] base::Status EnsureServiceType(const ServiceType& type);
  // Exports a service and returns the offer's id. Returns kInvalidArgument if the service listens
  // on loopback and the broker is on another host, because the broker could not call the service.
  [[nodiscard]] base::Result<std::string> Export(const std::string& type, CORBA::Object_ptr object,
                                                 const std::vector<Property>& properties);
  // Removes the offer with this id from the broker.
  [[nodiscard]] base::Status Withdraw(const std::string& id);
  // Sets `properties`. Other properties of the offer do not change.
  [[nodiscard]] base::Status Modify(const std::string& id, const std::vector<Property>& properties);
  // Returns at most `limit` offers with all their properties, in the order of `preference`.
  [[nodiscard]] base::Result<std::vector<FoundOffer>> Query(const std::string& type,
                                                            const std::string& constraint,
                                                            const std::string& preference,
                                                            std::size_t limit);

  [[nodiscard]] base::Result<std::vector<std::string>> ServiceTypeNames();
  // Returns the type with all inherited properties.
  [[nodiscard]] base::Result<ServiceType> DescribeServiceType(const std::string& name);
  // Returns the ids of all offers.
  [[nodiscard]] base::Result<std::vector<std::string>> OfferIds();
  // Returns the offer with this id.
  [[nodiscard]] base::Result<DescribedOffer> Describe(const std::string& id);

 private:
  BrokerClient() = default;
  // Resolves reference_ and gets the broker's interfaces.
  base::Status Resolve(CORBA::ORB_ptr orb, unsigned long timeout_ms);

  std::string reference_;  // the broker's address
  unsigned long timeout_ms_ = 0;
  CORBA::ORB_var orb_;
  CosTrading::Lookup_var lookup_;
  CosTrading::Register_var registry_;
  CosTrading::Admin_var admin_;  // nil if the broker does not have the interface
  CosTradingRepos::ServiceTypeRepository_var types_;
};

}  // namespace gsv::broker
