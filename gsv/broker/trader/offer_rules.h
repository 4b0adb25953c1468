// Checks an offer's properties against its service type.
//
// Source  OMG Trading Object Service (formal/00-06-27), "Register": export and modify.
#pragma once

#include <string>
#include <vector>

#include "gsv/broker/language/property.h"
#include "gsv/broker/offers/service_type.h"
#include "gsv/broker/trader/trader.h"

namespace gsv::broker {

// Returns the properties by name. `type` must be fully described. If `dynamic_allowed` is true,
// properties may be dynamic.
TradingResult<PropertyList> CheckExport(const ServiceType& type, std::vector<Property> properties,
                                        bool dynamic_allowed);

// Returns the modified properties. Applies either the whole modification or no part of it.
TradingResult<PropertyList> CheckModification(const ServiceType& type, PropertyList current,
                                              Modification modification, bool dynamic_allowed);

}  // namespace gsv::broker
