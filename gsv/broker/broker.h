// The Trading Service as a server on TCP, or on TLS if the environment requests it
// (orb/corba_access.h). It serves CosTrading Lookup, Register, Link, Proxy and Admin, and the
// ServiceTypeRepository, at "corbaloc::1.2@HOST:PORT/TradingService".
//
// A process has one broker and should not use CORBA for anything else. The broker limits every
// message of the process's ORB to 64 KiB. This also limits the content of an `any`, see
// docs/broker.md.
//
// Errors   kUnavailable if the port is in use, or if the host is no address of this machine; the
//          errors of OfferFile and of orb::PrepareAccess().
// Threads  every member may be called at any time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "gsv/base/error.h"
#include "gsv/broker/language/limits.h"
#include "gsv/broker/trader/liveness_monitor.h"

namespace gsv::broker {

struct BrokerOptions {
  std::string host = "127.0.0.1";  // the address to listen on
  std::uint16_t port = 0;          // 0 if the system chooses the port
  // Limits on untrusted input, such as the number of offers.
  TraderLimits limits;
  // The file in which offers and service types survive a restart. If the name is empty, offers and
  // types are in memory only.
  std::string data_file{};
  // How the broker finds and withdraws the offers of services that no longer exist.
  LivenessOptions liveness{};
};

class Broker {
 public:
  // Starts the broker. The broker serves requests when this function returns.
  [[nodiscard]] static base::Result<std::unique_ptr<Broker>> Start(const BrokerOptions& options);
  // Ends all calls and closes the port.
  ~Broker();
  Broker(const Broker&) = delete;
  Broker& operator=(const Broker&) = delete;

  // The address at which clients reach the broker: "corbaloc::1.2@HOST:PORT/TradingService", or
  // with TLS "corbaloc:ssliop:1.2@HOST:PORT/TradingService".
  const std::string& reference() const;
  // The port on which the broker listens, also if the system chose it.
  std::uint16_t port() const;

  // Closes the data file. The file then contains all acknowledged changes. Later changes are
  // refused.
  void Close();

 private:
  class Impl;
  explicit Broker(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace gsv::broker
