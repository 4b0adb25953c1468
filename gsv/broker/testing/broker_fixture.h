// For tests over TCP: a broker in another process. The ORB of this process is its client, and
// serves the offered services.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <COS/CosTrading.hh>
#include <COS/CosTradingRepos.hh>

#include "gsv/broker/language/property.h"
#include "gsv/broker/testing/broker_process.h"

namespace gsv::broker {

// Returns this process's ORB, which serves requests.
CORBA::ORB_ptr TestOrb();

// Returns a running service with the interface kServiceInterface.
CORBA::Object_ptr TestService();
constexpr const char* kServiceInterface = "IDL:omg.org/CosTradingDynamic/DynamicPropEval:1.0";

class BrokerFixture : public testing::Test {
 protected:
  using Repository = CosTradingRepos::ServiceTypeRepository;
  using Register = CosTrading::Register;
  using Lookup = CosTrading::Lookup;

  explicit BrokerFixture(std::vector<std::string> arguments = {"0"});

  // Adds a service type with the given properties.
  Repository::IncarnationNumber AddType(const std::string& name,
                                        const std::vector<Repository::PropStruct>& properties = {},
                                        const std::vector<std::string>& super_types = {},
                                        const std::string& interface_name = "");
  // Returns the definition of a property for AddType().
  static Repository::PropStruct Define(const char* name, CORBA::TypeCode_ptr type,
                                       Repository::PropertyMode mode);
  // Exports TestService() and returns the offer's id.
  std::string Export(const std::string& type, const std::vector<Property>& properties = {});
  // Converts properties to the sequence of the broker's interface.
  static CosTrading::PropertySeq Sequence(const std::vector<Property>& properties);
  // Returns a policy for Query().
  static CosTrading::Policy Policy(const char* name, const CORBA::Any& value);

  // The results of Lookup::query().
  struct Answer {
    CosTrading::OfferSeq_var offers;     // the first offers, at most `how_many`
    CosTrading::OfferIterator_var rest;  // iterator over the other offers; nil if there are none
    CosTrading::PolicyNameSeq_var limits_applied;  // names of the policies that limited the result
  };
  // Queries the broker. The first function requests all properties.
  Answer Query(const std::string& type, const std::string& constraint = "",
               const std::string& preference = "",
               const std::vector<CosTrading::Policy>& policies = {}, CORBA::ULong how_many = 100);
  Answer Query(const std::string& type, const std::string& constraint,
               const std::string& preference, const std::vector<CosTrading::Policy>& policies,
               CORBA::ULong how_many, const Lookup::SpecifiedProps& desired);

  BrokerProcess broker_;
  CosTrading::Lookup_var lookup_;  // the references of the broker's interfaces
  CosTrading::Register_var register_;
  CosTrading::Admin_var admin_;
  CosTradingRepos::ServiceTypeRepository_var types_;
};

// Calls `call`, which must raise `Exception`, and returns the exception.
template <typename Exception, typename Call>
Exception Raised(const Call& call) {
  try {
    call();
  } catch (const Exception& exception) {
    return exception;
  } catch (const CORBA::Exception& other) {
    ADD_FAILURE() << "raised " << other._name() << " instead of " << Exception()._name();
    return Exception();
  }
  ADD_FAILURE() << "did not raise " << Exception()._name();
  return Exception();
}

}  // namespace gsv::broker
