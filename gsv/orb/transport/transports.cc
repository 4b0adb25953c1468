#include "gsv/orb/transport/transports.h"

#include <memory>
#include <utility>
#include <vector>

#include "gsv/base/check.h"
#include "gsv/base/mutex.h"
#include "gsv/orb/transport/addresses.h"
#include "gsv/orb/transport/endpoint.h"

namespace gsv::orb {
namespace {

class TcpTransport final : public omni::tcpTransportImpl {
 public:
  omni::giopEndpoint* toEndpoint(const char* address) override {
    return isValid(address) ? new Endpoint<omni::tcpEndpoint>(address) : nullptr;
  }
  omni::giopAddress* toAddress(const char* text) override {
    IIOP::Address address;
    return parseAddress(text, address) ? new TcpAddress(address) : nullptr;
  }
};

class LocalTransport final : public omni::unixTransportImpl {
 public:
  omni::giopEndpoint* toEndpoint(const char* file) override {
    return isValid(file) ? new Endpoint<omni::unixEndpoint>(file) : nullptr;
  }
  omni::giopAddress* toAddress(const char* file) override {
    return isValid(file) ? new LocalAddress(file) : nullptr;
  }
};

class TlsTransport final : public omni::giopTransportImpl {
 public:
  explicit TlsTransport(std::shared_ptr<const TlsContext> context)
      : giopTransportImpl("giop:ssl"), context_(std::move(context)) {}

  omni::giopEndpoint* toEndpoint(const char* address) override {
    const bool is_possible = context_ != nullptr && omni::omniURI::validHostPortRange(address);
    return is_possible ? new Endpoint<omni::tcpEndpoint>(address, context_) : nullptr;
  }
  omni::giopAddress* toAddress(const char* text) override {
    const auto address = ReadHostAndPort(text);
    return address ? new TlsAddress(context_, *address) : nullptr;
  }
  CORBA::Boolean isValid(const char* text) override { return omni::omniURI::validHostPort(text); }
  CORBA::Boolean addToIOR(const char* text, omni::IORPublish* published) override {
    // The CSIv2 options for integrity, confidentiality, trust in the target and trust in the client
    // (CORBA 3.1 part 2, 10.5.1.1). TLS supports and requires all of them.
    constexpr CORBA::UShort kAll = 0x66;
    const auto address = ReadHostAndPort(text);
    if (!address) return false;
    omniIOR::add_TAG_SSL_SEC_TRANS(*address, kAll, kAll, published);
    return true;
  }
  const omnivector<const char*>* getInterfaceAddress() override {
    return omni::giopTransportImpl::getInterfaceAddress("giop:tcp");
  }

 private:
  const std::shared_ptr<const TlsContext> context_;
};

// Renames omniORB's transport for `address` to `name`. omniORB uses the first transport with a
// given name, and that must be GSV's.
void GiveUpName(const char* address, const char* name) {
  omni::giopTransportImpl* const plain = omni::giopTransportImpl::str2Transport(address);
  GSV_CHECK(plain != nullptr);
  plain->type = name;
}

// TLS transports are never destroyed, because connections and references of their ORB may use them.
struct Installed {
  base::Mutex mutex;
  std::unique_ptr<TcpTransport> tcp GSV_GUARDED_BY(mutex);
  std::unique_ptr<LocalTransport> local GSV_GUARDED_BY(mutex);
  // the last element is the current transport
  std::vector<std::unique_ptr<TlsTransport>> tls GSV_GUARDED_BY(mutex);
  // certificate of the current TLS transport
  std::optional<CorbaCertificate> certificate GSV_GUARDED_BY(mutex);
};
Installed& InstalledTransports() {
  // never destroyed, because an ORB may outlive static objects
  static auto& installed = *new Installed;
  return installed;
}

}  // namespace

base::Status InstallTransports(const std::optional<CorbaCertificate>& certificate) {
  Installed& installed = InstalledTransports();
  const base::MutexLock lock(installed.mutex);
  if (installed.tcp == nullptr) {
    GiveUpName("giop:tcp:h:1", "giop:plain-tcp");
    GiveUpName("giop:unix:/f", "giop:plain-unix");
    installed.tcp = std::make_unique<TcpTransport>();
    installed.local = std::make_unique<LocalTransport>();
  }
  if (!installed.tls.empty() && certificate == installed.certificate) return {};
  std::shared_ptr<const TlsContext> context;
  if (certificate) {
    auto read = TlsContext::Read(*certificate);
    if (!read) return base::Fail(read.error());
    context = *std::move(read);
  }
  if (!installed.tls.empty()) installed.tls.back()->type = "giop:former-ssl";
  installed.tls.push_back(std::make_unique<TlsTransport>(std::move(context)));
  installed.certificate = certificate;
  return {};
}

bool SpeaksTls() {
  const base::MutexLock lock(InstalledTransports().mutex);
  return InstalledTransports().certificate.has_value();
}

}  // namespace gsv::orb
