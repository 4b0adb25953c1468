// The addresses that the ORB connects to, by TCP, TLS or a socket in the file system.
#pragma once

#include <memory>
#include <optional>

#include "gsv/orb/transport/connection.h"
#include "gsv/orb/transport/tls_context.h"

namespace gsv::orb {

// Parses "HOST:PORT". Returns nullopt for other texts.
std::optional<IIOP::Address> ReadHostAndPort(const char* text);

// An address by TCP.
class TcpAddress final : public omni::tcpAddress {
 public:
  explicit TcpAddress(const IIOP::Address& address) : tcpAddress(address), address_(address) {}

  omni::giopAddress* duplicate() const override { return new TcpAddress(address_); }
  omni::giopAddress* duplicate(const char* host) const override;
  omni::giopActiveConnection* Connect(const omni_time_t& deadline, CORBA::ULong flags,
                                      CORBA::Boolean& timed_out) const override;

 private:
  IIOP::Address address_;
};

// An address by TLS over TCP.
class TlsAddress final : public omni::tcpAddress {
 public:
  // If `context` is null, connecting fails, and NoteTlsFailure() gets the reason.
  TlsAddress(std::shared_ptr<const TlsContext> context, const IIOP::Address& address);

  const char* type() const override { return "giop:ssl"; }
  const char* address() const override { return text_; }
  omni::giopAddress* duplicate() const override { return new TlsAddress(context_, address_); }
  omni::giopAddress* duplicate(const char* host) const override;
  omni::giopActiveConnection* Connect(const omni_time_t& deadline, CORBA::ULong flags,
                                      CORBA::Boolean& timed_out) const override;

 private:
  const std::shared_ptr<const TlsContext> context_;  // null if this process has no certificate
  IIOP::Address address_;
  CORBA::String_var text_;  // the address as a URI
};

// The file of a Unix domain socket as an address.
class LocalAddress final : public omni::unixAddress {
 public:
  explicit LocalAddress(const char* file) : unixAddress(file), file_(file) {}

  omni::giopAddress* duplicate() const override { return new LocalAddress(file_); }
  omni::giopActiveConnection* Connect(const omni_time_t& deadline, CORBA::ULong flags,
                                      CORBA::Boolean& timed_out) const override;

 private:
  CORBA::String_var file_;
};

}  // namespace gsv::orb
