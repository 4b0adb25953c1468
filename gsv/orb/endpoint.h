// Where an ORB listens: by TCP, or by TLS. A handshake is done by the thread that accepts, a step
// whenever bytes have come, and never waited for: who stalls holds up nobody, and no thread of the
// ORB sees a peer before it has shown its certificate.
//
// Whoever includes it needs omniORB's internal headers, see CMakeLists.txt.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <vector>

#include "gsv/orb/connection.h"

// clang-format off
#include <omniORB4/tcpEndpoint.h>
// clang-format on

namespace gsv::orb {

class Alarm;
class Newcomer;

class Endpoint : public omni::tcpEndpoint {
 public:
  // `address`: "HOST:PORT", which must outlive it. Without a context: TCP alone.
  explicit Endpoint(const char* address, std::shared_ptr<const TlsContext> context);
  ~Endpoint() override;

  const char* type() const override;
  CORBA::Boolean publish(const omni::orbServer::PublishSpecs& specifications,
                         CORBA::Boolean all_specifications, CORBA::Boolean all_endpoints,
                         omni::orbServer::EndpointList& published) override;
  omni::giopConnection* AcceptAndMonitor(omni::giopConnection::notifyReadable_t readable,
                                         void* cookie) override;
  void Poke() override;

 protected:
  virtual Connection* MakeConnection(int socket, std::unique_ptr<TlsChannel> channel);
  // There are bytes to be read: whether the ORB shall read now.
  virtual bool ShallRead(Connection* connection);

  CORBA::Boolean notifyReadable(omni::SocketHolder* holder) override;

 private:
  void Accept(int socket);
  void Proceed(Newcomer* newcomer);
  void Dismiss();

  const std::shared_ptr<const TlsContext> context_;
  std::deque<Connection*> accepted_;                  // of which the ORB does not know yet
  std::vector<std::unique_ptr<Newcomer>> newcomers_;  // the oldest first
  std::unique_ptr<Alarm> alarm_;                      // rings while there are any
  omni::giopConnection::notifyReadable_t readable_ = nullptr;
  void* cookie_ = nullptr;
  std::atomic<bool> poked_ = false;  // by another thread
};

}  // namespace gsv::orb
