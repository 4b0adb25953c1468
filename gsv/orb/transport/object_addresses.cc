#include "gsv/orb/transport/object_addresses.h"

#include "gsv/orb/transport/omniorb_internals.h"

namespace gsv::orb {

std::vector<std::string> AddressesIn(CORBA::Object_ptr object) {
  if (CORBA::is_nil(object) || object->_PR_getobj() == nullptr) return {};
  std::vector<std::string> addresses;
  omniIOR_var ior = object->_PR_getobj()->_getIOR();
  for (const omni::giopAddress* each : ior->getIORInfo()->addresses()) {
    addresses.emplace_back(each->address());
  }
  return addresses;
}

}  // namespace gsv::orb
