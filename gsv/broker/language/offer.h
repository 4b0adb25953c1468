// An offer: the reference of a service, and properties by which clients find it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gsv/broker/language/interned.h"
#include "gsv/broker/language/property.h"

namespace gsv::broker {

// The additional members of a proxy offer, which stands for another trader's offers of its type.
struct ProxyPart {
  bool if_match_all = false;  // whether the proxy matches every constraint
  std::string recipe{};       // see recipe.h
  std::string policies{};     // policies to be passed on, as CDR of a CosTrading::PolicySeq
};

// An offer is immutable: a modification replaces it by a new object. So any thread may read an
// offer without a lock.
struct Offer {
  std::uint64_t number = 0;    // position in the order of export, from 1
  Interned<std::string> type;  // name of the service type
  std::string reference;       // reference of the service, or of a proxy's target: "IOR:…"
  PropertyList properties;
  std::shared_ptr<const ProxyPart> proxy{};  // null for an ordinary offer
};

using OfferPtr = std::shared_ptr<const Offer>;
using Offers = std::vector<OfferPtr>;

}  // namespace gsv::broker
