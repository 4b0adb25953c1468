// Converts the types of properties between CORBA and the trader.
#pragma once

#include <omniORB4/CORBA.h>

#include "gsv/broker/language/value.h"

namespace gsv::broker {

// Returns the type that the constraint language uses: aliases are resolved. The member `encoded` of
// the result is empty.
PropertyType Classify(CORBA::TypeCode_ptr type);
// Like Classify(), but `encoded` has the TypeCode if `type` is an alias or of kind kOther.
PropertyType ToPropertyType(CORBA::TypeCode_ptr type);
// Returns a new reference, which the caller releases.
CORBA::TypeCode_ptr ToTypeCode(const PropertyType& type);

}  // namespace gsv::broker
