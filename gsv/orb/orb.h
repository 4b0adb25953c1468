// The ORB of this process. It listens on loopback by default, uses TLS according to environment
// variables (corba_access.h), limits the time of every call, closes idle connections, and accepts
// messages large enough for images.
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
  bool local_socket = false;       // also listen on a local socket if possible, see local_socket.h
  std::uint64_t max_message_bytes = 64u << 20;  // with its header
  std::chrono::seconds message_time{30};        // time limit for receiving a message
  std::chrono::milliseconds call_timeout{10'000};
  // Removes arguments that crash omniORB, see broker::CheckRequest(). Null: no check.
  void (*check_request)(std::string& message) = nullptr;
  // A call in progress occupies its connection: use at least the number of agents that wait at the
  // same time.
  int max_connections_per_server = 4096;
};

// Starts the ORB and its root POA. Fails with a sentence when the port is taken, a certificate
// cannot be used, or the address takes one.
base::Result<CORBA::ORB_var> StartOrb(const OrbOptions& options);

// The process's ORB. If none was started, starts one for outgoing calls only.
base::Result<CORBA::ORB_var> CallingOrb();

PortableServer::POA_ptr RootPoa(CORBA::ORB_ptr orb);  // the caller owns the reference

// The local address from which `host` is reached, to listen on for peers there; "127.0.0.1" for a
// loopback host.
base::Result<std::string> LocalAddressTowards(const std::string& host);

// The host and port that a reference points to, by TCP or TLS, "127.0.0.1:40123"; empty if it
// contains none.
std::string AddressOf(CORBA::Object_ptr object);

// Sets the time limit of calls through this reference, for all threads.
void LimitCalls(CORBA::Object_ptr object, std::chrono::milliseconds timeout);

}  // namespace gsv::orb
