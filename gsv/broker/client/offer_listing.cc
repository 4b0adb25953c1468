#include "gsv/broker/client/offer_listing.h"

#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/trader/service_reference.h"
#include "gsv/orb/orb.h"

namespace gsv::broker {
namespace {

OfferDescription Describe(CORBA::ORB_ptr orb, const DescribedOffer& offer) {
  const CORBA::String_var ior = orb->object_to_string(offer.object);
  OfferDescription description{.id = offer.id,
                               .type = offer.type,
                               .interface_id = {},
                               .address = {},
                               .reference = ior.in(),
                               .properties = offer.properties};
  if (const auto service = ReadReference(ior.in())) {
    description.interface_id = service->type_id;
    description.address = service->Address();
  }
  return description;
}

}  // namespace

base::Result<std::vector<OfferDescription>> ListOffers(const std::string& broker,
                                                       std::chrono::milliseconds timeout) {
  const auto orb = orb::CallingOrb();
  if (!orb) return base::Fail(orb.error());
  auto client = BrokerClient::Connect(*orb, broker, timeout);
  if (!client) return base::Fail(client.error());
  const auto ids = client->OfferIds();
  if (!ids) return base::Fail(ids.error());
  std::vector<OfferDescription> offers;
  for (const std::string& id : *ids) {
    const auto offer = client->Describe(id);
    // Skips an offer that was withdrawn after its id was listed.
    if (!offer && offer.error().code == base::ErrorCode::kNotFound) continue;
    if (!offer) return base::Fail(offer.error());
    offers.push_back(Describe(*orb, *offer));
  }
  return offers;
}

base::Result<std::vector<ServiceType>> ListServiceTypes(const std::string& broker,
                                                        std::chrono::milliseconds timeout) {
  const auto orb = orb::CallingOrb();
  if (!orb) return base::Fail(orb.error());
  auto client = BrokerClient::Connect(*orb, broker, timeout);
  if (!client) return base::Fail(client.error());
  const auto names = client->ServiceTypeNames();
  if (!names) return base::Fail(names.error());
  std::vector<ServiceType> types;
  for (const std::string& name : *names) {
    auto type = client->DescribeServiceType(name);
    if (!type && type.error().code == base::ErrorCode::kNotFound) continue;
    if (!type) return base::Fail(type.error());
    types.push_back(std::move(*type));
  }
  return types;
}

}  // namespace gsv::broker
