// Checks whether a service has the interface that its service type requires.
#pragma once

#include <string>
#include <string_view>

#include <omniORB4/CORBA.h>

namespace gsv::broker {

// Whether a service has the required interface. kUnknown means that this could not be determined.
enum class Conformance { kConforms, kDiffers, kUnknown };

// Checks only the type id in the reference. `interface_name` is a repository identifier, a scoped
// name, or empty. Returns kUnknown if the reference may be of a derived interface.
Conformance CompareInterface(std::string_view type_id, std::string_view interface_name);

// Calls CompareInterface(). If the result is unknown, it calls the service (_is_a) with a time
// limit of one second. Returns kUnknown if the service does not answer.
Conformance CheckInterface(CORBA::Object_ptr service, std::string_view type_id,
                           const std::string& interface_name);

}  // namespace gsv::broker
