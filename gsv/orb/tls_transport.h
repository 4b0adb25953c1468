// omniORB's transport "giop:ssl", as GSV speaks it. On the wire it is omniORB's own, and what other
// ORBs call SSLIOP; ADR 021 says why omniORB's is not used.
//
// Whoever includes it needs omniORB's internal headers, see CMakeLists.txt.
#pragma once

#include <memory>

#include "gsv/orb/connection.h"

namespace gsv::orb {

class TlsTransport : public omni::giopTransportImpl {
 public:
  // Without a context it has no endpoints, and calls fail with a sentence.
  explicit TlsTransport(std::shared_ptr<const TlsContext> context);

  omni::giopEndpoint* toEndpoint(const char* address) override;
  omni::giopAddress* toAddress(const char* text) override;
  CORBA::Boolean isValid(const char* text) override;
  CORBA::Boolean addToIOR(const char* text, omni::IORPublish* published) override;
  const omnivector<const char*>* getInterfaceAddress() override;

  const std::shared_ptr<const TlsContext>& context() const { return context_; }
  virtual omni::giopActiveConnection* MakeConnection(int socket,
                                                     std::unique_ptr<TlsChannel> channel);

 private:
  const std::shared_ptr<const TlsContext> context_;
};

}  // namespace gsv::orb
