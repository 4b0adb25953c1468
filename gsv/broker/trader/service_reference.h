// Reads type id and address from a stringified object reference, without an ORB.
//
// Source  CORBA 3.1 part 2, 7.6.2 (IOR), 7.7.2 (IIOP profile), 10.5.1.1 (TAG_SSL_SEC_TRANS).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "gsv/base/error.h"

namespace gsv::broker {

struct ServiceReference {
  std::string type_id;  // such as "IDL:omg.org/CosTrading/Lookup:1.0"; may be empty
  std::string host;     // host of the first IIOP profile; empty if there is none
  std::uint16_t port = 0;
  bool takes_tls = false;  // whether the address accepts only TLS

  // Returns "127.0.0.1:4321" or "[::1]:4321", or an empty text if there is no host.
  std::string Address() const;
};

// Errors  kCorrupt if `ior` is not "IOR:" followed by the digits of a reference.
base::Result<ServiceReference> ReadReference(std::string_view ior);

}  // namespace gsv::broker
