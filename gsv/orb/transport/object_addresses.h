// Lists the addresses in an object reference.
#pragma once

#include <string>
#include <vector>

#include <omniORB4/CORBA.h>

namespace gsv::orb {

// Returns URIs such as "giop:tcp:127.0.0.1:40123", in the order in which the ORB tries them; none
// for a nil reference. Can be called on any thread.
std::vector<std::string> AddressesIn(CORBA::Object_ptr object);

}  // namespace gsv::orb
