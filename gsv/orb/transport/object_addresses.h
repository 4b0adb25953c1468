// Lists the addresses in an object reference.
#pragma once

#include <string>
#include <vector>

#include <omniORB4/CORBA.h>

namespace gsv::orb {

// Returns URIs such as "giop:tcp:127.0.0.1:40123", in the order in which the ORB tries them. A nil
// reference has none. Any thread may call it.
std::vector<std::string> AddressesIn(CORBA::Object_ptr object);

}  // namespace gsv::orb
