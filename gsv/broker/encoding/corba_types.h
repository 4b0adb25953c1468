// Properties' types between CORBA and the trader.
#pragma once

#include <omniORB4/CORBA.h>

#include "gsv/broker/language/value.h"

namespace gsv::broker {

// The type as the constraint language sees it, `encoded` left empty: aliases are not kept.
PropertyType Classify(CORBA::TypeCode_ptr type);
PropertyType ToPropertyType(CORBA::TypeCode_ptr type);
// A new reference.
CORBA::TypeCode_ptr ToTypeCode(const PropertyType& type);

}  // namespace gsv::broker
