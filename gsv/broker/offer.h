// One offer: a service, found by what is said of it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gsv/broker/property.h"

namespace gsv::broker {

// Immutable: a modification replaces the offer, so that whoever holds one may read it at leisure.
struct Offer {
  std::uint64_t number = 0;  // in the order of export, from 1
  std::string type;
  std::string reference;  // of the service: "IOR:…"
  PropertyList properties;
};

using OfferPtr = std::shared_ptr<const Offer>;
using Offers = std::vector<OfferPtr>;

}  // namespace gsv::broker
