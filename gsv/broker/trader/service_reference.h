// What a stringified object reference says about itself, read without an ORB.
//
// Source  CORBA 3.1 part 2, 7.6.2 (IOR), 7.7.2 (IIOP profile).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "gsv/base/error.h"

namespace gsv::broker {

struct ServiceReference {
  std::string type_id;  // "IDL:omg.org/CosTrading/Lookup:1.0"; may be empty
  std::string host;     // of the first IIOP profile; empty when there is none
  std::uint16_t port = 0;

  // "127.0.0.1:4321", "[::1]:4321", or nothing.
  std::string Address() const;
};

// Errors  kCorrupt when `ior` is not "IOR:" and the digits of a reference.
base::Result<ServiceReference> ReadReference(std::string_view ior);

// True for 127.0.0.0/8, ::1 and "localhost".
bool IsLoopback(std::string_view host);

}  // namespace gsv::broker
