// Whether a service has the interface that its service type demands.
#pragma once

#include <string>
#include <string_view>

#include <omniORB4/CORBA.h>

namespace gsv::broker {

enum class Conformance { kConforms, kDiffers, kUnknown };

// Checks only the type id in the reference: `interface_name` is a repository identifier, a scoped
// name, or nothing. kUnknown where the reference may be of a derived interface.
Conformance CompareInterface(std::string_view type_id, std::string_view interface_name);

// As CompareInterface, then by asking the service (_is_a), for at most a second. kUnknown when it
// does not answer.
Conformance CheckInterface(CORBA::Object_ptr service, std::string_view type_id,
                           const std::string& interface_name);

}  // namespace gsv::broker
