// TCP and TLS for the broker's ORB over which only messages come that omniORB can unmarshal without
// harm (checked_connection.h), those of clients and those of the services that the broker asks.
#pragma once

#include <cstddef>
#include <memory>

namespace omni {
class giopTransportImpl;
}
namespace gsv::orb {
class TlsContext;
}

namespace gsv::broker {

// All of this process's ORB's TCP connections are checked from now on, and `connections` of
// clients are kept open at most: then the one that has been silent longest is dropped. Call it
// once, before ORB_init().
void InstallCheckedTransport(std::size_t connections);

// The same by TLS, for orb::PrepareAccess().
std::unique_ptr<omni::giopTransportImpl> MakeCheckedTlsTransport(
    std::shared_ptr<const orb::TlsContext> context, std::size_t connections);

}  // namespace gsv::broker
