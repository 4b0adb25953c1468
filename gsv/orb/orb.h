// The ORB of this process, with the settings that a distributed simulator needs: loopback by
// default, TLS as the environment's variables say (corba_access.h), a time limit on every call,
// idle connections closed, messages large enough for images.
//
// Threads  StartOrb() once a process, before any other use of CORBA.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include <omniORB4/CORBA.h>

#include "gsv/base/error.h"

namespace gsv::orb {

struct OrbOptions {
  std::string host = "127.0.0.1";  // the address to listen on
  int port = 0;                    // 0: the system chooses
  bool local_socket = false;       // besides, see local_socket.h; where that is possible
  std::uint64_t max_message_bytes = 64u << 20;  // with its header
  std::chrono::seconds message_time{30};        // that a message may take to come
  std::chrono::milliseconds call_timeout{10'000};
  // Cuts off arguments that omniORB does not survive, see broker::CheckRequest(). Null: none.
  void (*check_request)(std::string& message) = nullptr;
  // A call in progress occupies its connection: at least as many as agents that wait at once.
  int max_connections_per_server = 4096;
};

// Starts the ORB and its root POA. Fails with a sentence when the port is taken, a certificate
// cannot be used, or the address takes one.
base::Result<CORBA::ORB_var> StartOrb(const OrbOptions& options);

// The process's ORB; where there is none, one that only calls others.
base::Result<CORBA::ORB_var> CallingOrb();

PortableServer::POA_ptr RootPoa(CORBA::ORB_ptr orb);  // the caller owns the reference

// The local address from which `host` is reached, to listen on for peers there; "127.0.0.1" for a
// loopback host.
base::Result<std::string> LocalAddressTowards(const std::string& host);

// The host and port that a reference points to, by TCP or TLS, "127.0.0.1:40123"; empty when it
// names none.
std::string AddressOf(CORBA::Object_ptr object);

// Limits how long calls through this reference may take, from all threads.
void LimitCalls(CORBA::Object_ptr object, std::chrono::milliseconds timeout);

}  // namespace gsv::orb
