// The Trading Service as a server on TCP, or TLS as the environment says (orb/corba_access.h):
// CosTrading Lookup, Register, Link, Proxy and Admin, and the ServiceTypeRepository, at
// "corbaloc::1.2@HOST:PORT/TradingService".
//
// One in a process, which should do nothing else with CORBA: what an `any` may hold bounds the
// size of every message of its ORB (64 KiB), see docs/broker.md.
//
// Errors   kUnavailable: the port is in use, or the host is not this machine's; those of
//          OfferFile, and of orb::PrepareAccess().
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
  std::uint16_t port = 0;          // 0: the system chooses
  TraderLimits limits;
  // Keeps offers and service types from one start to the next; empty: in memory only.
  std::string data_file{};
  LivenessOptions liveness{};
};

class Broker {
 public:
  // Serves from the moment it returns.
  [[nodiscard]] static base::Result<std::unique_ptr<Broker>> Start(const BrokerOptions& options);
  // Ends every call and closes the port.
  ~Broker();
  Broker(const Broker&) = delete;
  Broker& operator=(const Broker&) = delete;

  const std::string& reference() const;
  std::uint16_t port() const;

  // Closes the data file, which holds all that was answered; changes are refused from then on.
  void Close();

 private:
  class Impl;
  explicit Broker(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace gsv::broker
