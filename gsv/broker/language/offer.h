// One offer: a service, found by what is said of it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gsv/broker/language/property.h"

namespace gsv::broker {

// What a proxy offer has more: it stands for the offers that another trader has of its type.
struct ProxyPart {
  bool if_match_all = false;  // it matches whatever the constraint says
  std::string recipe{};       // see recipe.h
  std::string policies{};     // to be passed on: CDR of a CosTrading::PolicySeq
};

// Immutable: a modification replaces the offer, so that whoever holds one may read it at leisure.
struct Offer {
  std::uint64_t number = 0;  // in the order of export, from 1
  std::string type;
  std::string reference;  // of the service, or of a proxy's target: "IOR:…"
  PropertyList properties;
  std::shared_ptr<const ProxyPart> proxy{};  // null: an offer like any other
};

using OfferPtr = std::shared_ptr<const Offer>;
using Offers = std::vector<OfferPtr>;

}  // namespace gsv::broker
