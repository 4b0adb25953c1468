#include "gsv/broker/client/broker_client.h"

#include <algorithm>

#include <fmt/format.h>

#include "gsv/base/sorting.h"
#include "gsv/broker/client/client_errors.h"
#include "gsv/broker/client/corbaloc.h"
#include "gsv/broker/encoding/corba_values.h"
#include "gsv/broker/trader/service_reference.h"
#include "gsv/orb/corba_access.h"

namespace gsv::broker {
namespace {

using base::ErrorCode;
using Repository = CosTradingRepos::ServiceTypeRepository;

constexpr CORBA::ULong kBatch = 100;

template <typename Reference>
void SetTimeout(const Reference& reference, unsigned long timeout_ms) {
  if (!CORBA::is_nil(reference)) omniORB::setClientCallTimeout(reference, timeout_ms);
}

CosTrading::PropertySeq ToCorba(const std::vector<Property>& properties) {
  CosTrading::PropertySeq result;
  result.length(static_cast<CORBA::ULong>(properties.size()));
  for (CORBA::ULong i = 0; i < properties.size(); ++i) {
    FillProperty(properties[i].name, properties[i].value, result[i]);
  }
  return result;
}

// Another trader might send a name twice. The last value applies.
PropertyList ToList(const CosTrading::PropertySeq& properties) {
  return PropertyList::LastOfEachName(ToProperties(properties));
}

bool SameDefinition(ServiceType a, ServiceType b) {
  const auto by_name = [](const PropertyDefinition& x, const PropertyDefinition& y) {
    return x.name < y.name;
  };
  base::Sort(a.properties, by_name);
  base::Sort(b.properties, by_name);
  base::Sort(a.super_types);
  base::Sort(b.super_types);
  const auto same = [](const PropertyDefinition& x, const PropertyDefinition& y) {
    return x.name == y.name && x.type == y.type && x.mode == y.mode;
  };
  return a.interface_name == b.interface_name && a.super_types == b.super_types &&
         std::equal(a.properties.begin(), a.properties.end(), b.properties.begin(),
                    b.properties.end(), same);
}

// Returns the value of -ORBInitRef, or nil if it is not set.
CORBA::Object_ptr InitialReference(CORBA::ORB_ptr orb) {
  try {
    return orb->resolve_initial_references("TradingService");
  } catch (const CORBA::ORB::InvalidName&) {
    return CORBA::Object::_nil();
  } catch (const CORBA::NO_RESOURCES&) {
    return CORBA::Object::_nil();
  }
}

void AppendOffers(const CosTrading::OfferSeq& offers, std::size_t limit,
                  std::vector<FoundOffer>& found) {
  for (CORBA::ULong i = 0; i < offers.length() && found.size() < limit; ++i) {
    found.push_back({CORBA::Object::_duplicate(offers[i].reference), ToList(offers[i].properties)});
  }
}

// Returns an error if the broker is on another host and the service listens on this host's loopback
// address. The broker cannot reach such a service.
base::Status CheckReachable(CORBA::ORB_ptr orb, CORBA::Object_ptr object,
                            const std::string& broker) {
  const std::string broker_host = HostOf(broker);
  if (broker_host.empty() || orb::IsLoopback(broker_host)) return {};
  const CORBA::String_var ior = orb->object_to_string(object);
  const auto service = ReadReference(ior.in());
  if (!service || !orb::IsLoopback(service->host)) return {};
  return base::Fail(ErrorCode::kInvalidArgument,
                    fmt::format("the service listens on {}, which the host of the broker cannot "
                                "reach; give it an -ORBendPoint on an external address",
                                service->Address()),
                    broker);
}

}  // namespace

base::Result<BrokerClient> BrokerClient::Connect(CORBA::ORB_ptr orb, const std::string& reference,
                                                 std::chrono::milliseconds timeout) {
  BrokerClient client;
  client.timeout_ms_ = static_cast<unsigned long>(timeout.count());
  client.orb_ = CORBA::ORB::_duplicate(orb);
  if (!reference.empty()) {
    auto normalised = NormaliseReference(reference);
    if (!normalised) return base::Fail(normalised.error());
    client.reference_ = std::move(*normalised);
  }
  const std::string where = reference.empty() ? "TradingService" : client.reference_;
  return GuardedRepeatable(where, [&]() -> base::Result<BrokerClient> {
    if (auto resolved = client.Resolve(orb, client.timeout_ms_); !resolved) {
      return base::Fail(resolved.error());
    }
    return client;
  });
}

base::Status BrokerClient::Resolve(CORBA::ORB_ptr orb, unsigned long timeout_ms) {
  CORBA::Object_var object;
  try {
    object = reference_.empty() ? InitialReference(orb) : orb->string_to_object(reference_.c_str());
  } catch (const CORBA::BAD_PARAM&) {
    return base::Fail(ErrorCode::kInvalidArgument,
                      "the address of a broker has the form corbaloc::1.2@HOST:PORT/TradingService",
                      reference_);
  }
  if (CORBA::is_nil(object)) {
    return base::Fail(ErrorCode::kInvalidArgument,
                      "no broker is given; use --broker corbaloc::1.2@HOST:PORT/TradingService or "
                      "-ORBInitRef TradingService=...");
  }
  // The timeout is stored in the reference, so it also limits the call that _narrow() makes.
  SetTimeout(object, timeout_ms);
  lookup_ = CosTrading::Lookup::_narrow(object);
  if (CORBA::is_nil(lookup_)) {
    return base::Fail(ErrorCode::kUnavailable, "the object at this address is not a broker",
                      reference_);
  }
  SetTimeout(lookup_, timeout_ms);
  registry_ = lookup_->register_if();
  admin_ = lookup_->admin_if();
  const CORBA::Object_var types = lookup_->type_repos();
  SetTimeout(types, timeout_ms);
  types_ = Repository::_narrow(types);
  if (CORBA::is_nil(registry_) || CORBA::is_nil(types_)) {
    return base::Fail(ErrorCode::kUnavailable, "this broker does not accept offers", reference_);
  }
  SetTimeout(registry_, timeout_ms);
  SetTimeout(admin_, timeout_ms);
  SetTimeout(types_, timeout_ms);
  return {};
}

base::Status BrokerClient::EnsureServiceType(const ServiceType& type) {
  return GuardedRepeatable(reference_, [&]() -> base::Status {
    Repository::PropStructSeq props;
    props.length(static_cast<CORBA::ULong>(type.properties.size()));
    for (CORBA::ULong i = 0; i < type.properties.size(); ++i) {
      props[i] = broker::ToCorba(type.properties[i]);
    }
    Repository::ServiceTypeNameSeq super_types;
    super_types.length(static_cast<CORBA::ULong>(type.super_types.size()));
    for (CORBA::ULong i = 0; i < type.super_types.size(); ++i) {
      super_types[i] = type.super_types[i].c_str();
    }
    try {
      types_->add_type(type.name.c_str(), type.interface_name.c_str(), props, super_types);
    } catch (const Repository::ServiceTypeExists&) {
      const Repository::TypeStruct_var known = types_->describe_type(type.name.c_str());
      if (!SameDefinition(type, ToServiceType(type.name, known.in()))) throw;
    }
    return {};
  });
}

base::Result<std::string> BrokerClient::Export(const std::string& type, CORBA::Object_ptr object,
                                               const std::vector<Property>& properties) {
  return Guarded(reference_, [&]() -> base::Result<std::string> {
    if (auto reachable = CheckReachable(orb_, object, reference_); !reachable) {
      return base::Fail(reachable.error());
    }
    const CORBA::String_var id = registry_->_cxx_export(object, type.c_str(), ToCorba(properties));
    return std::string(id.in());
  });
}

base::Status BrokerClient::Withdraw(const std::string& id) {
  return Guarded(reference_, [&]() -> base::Status {
    registry_->withdraw(id.c_str());
    return {};
  });
}

base::Status BrokerClient::Modify(const std::string& id, const std::vector<Property>& properties) {
  return Guarded(reference_, [&]() -> base::Status {
    registry_->modify(id.c_str(), {}, ToCorba(properties));
    return {};
  });
}

base::Result<std::vector<FoundOffer>> BrokerClient::Query(const std::string& type,
                                                          const std::string& constraint,
                                                          const std::string& preference,
                                                          std::size_t limit) {
  return GuardedRepeatable(reference_, [&]() -> base::Result<std::vector<FoundOffer>> {
    CosTrading::Lookup::SpecifiedProps desired;
    desired._d(CosTrading::Lookup::all);
    CosTrading::OfferSeq_var offers;
    CosTrading::OfferIterator_var rest;
    CosTrading::PolicyNameSeq_var limits_applied;
    lookup_->query(type.c_str(), constraint.c_str(), preference.c_str(), {}, desired,
                   static_cast<CORBA::ULong>(std::min<std::size_t>(limit, kBatch)), offers, rest,
                   limits_applied);
    std::vector<FoundOffer> found;
    AppendOffers(offers, limit, found);
    if (CORBA::is_nil(rest)) return found;
    SetTimeout(rest, timeout_ms_);
    bool more = true;
    while (more && found.size() < limit) {
      more = rest->next_n(kBatch, offers);
      AppendOffers(offers, limit, found);
      if (offers->length() == 0) break;
    }
    rest->destroy();
    return found;
  });
}

base::Result<std::vector<std::string>> BrokerClient::ServiceTypeNames() {
  return GuardedRepeatable(reference_, [&]() -> base::Result<std::vector<std::string>> {
    Repository::SpecifiedServiceTypes which;
    which._default();
    Repository::ServiceTypeNameSeq_var names = types_->list_types(which);
    std::vector<std::string> result;
    for (CORBA::ULong i = 0; i < names->length(); ++i) result.emplace_back(names[i]);
    return result;
  });
}

base::Result<ServiceType> BrokerClient::DescribeServiceType(const std::string& name) {
  return GuardedRepeatable(reference_, [&]() -> base::Result<ServiceType> {
    const Repository::TypeStruct_var description = types_->fully_describe_type(name.c_str());
    return ToServiceType(name, description.in());
  });
}

base::Result<std::vector<std::string>> BrokerClient::OfferIds() {
  return GuardedRepeatable(reference_, [&]() -> base::Result<std::vector<std::string>> {
    if (CORBA::is_nil(admin_)) {
      return base::Fail(ErrorCode::kUnavailable, "this broker does not list its offers",
                        reference_);
    }
    CosTrading::OfferIdSeq_var ids;
    CosTrading::OfferIdIterator_var rest;
    admin_->list_offers(kBatch, ids, rest);
    std::vector<std::string> result;
    const auto append = [&] {
      for (CORBA::ULong i = 0; i < ids->length(); ++i) result.emplace_back(ids[i]);
    };
    append();
    if (CORBA::is_nil(rest)) return result;
    SetTimeout(rest, timeout_ms_);
    for (bool more = true; more;) {
      more = rest->next_n(kBatch, ids) && ids->length() > 0;
      append();
    }
    rest->destroy();
    return result;
  });
}

base::Result<DescribedOffer> BrokerClient::Describe(const std::string& id) {
  return GuardedRepeatable(reference_, [&]() -> base::Result<DescribedOffer> {
    const CosTrading::Register::OfferInfo_var offer = registry_->describe(id.c_str());
    return DescribedOffer{id, offer->type.in(), CORBA::Object::_duplicate(offer->reference),
                          ToList(offer->properties)};
  });
}

}  // namespace gsv::broker
