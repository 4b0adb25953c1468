// What a service type demands of an offer's properties.
//
// Source  OMG Trading Object Service (formal/00-06-27), "Register": export and modify.
#pragma once

#include <string>
#include <vector>

#include "gsv/broker/language/property.h"
#include "gsv/broker/offers/service_type.h"
#include "gsv/broker/trader/trader.h"

namespace gsv::broker {

// `type` is fully described; with `dynamic_allowed`, properties may be dynamic. The properties in
// the order of their names.
TradingResult<PropertyList> CheckExport(const ServiceType& type, std::vector<Property> properties,
                                        bool dynamic_allowed);

// The properties that `current` becomes. All of the modification is done, or nothing.
TradingResult<PropertyList> CheckModification(const ServiceType& type, PropertyList current,
                                              Modification modification, bool dynamic_allowed);

}  // namespace gsv::broker
