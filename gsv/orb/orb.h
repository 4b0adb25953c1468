// The ORB of this process. By default it listens on loopback. Environment variables select TLS
// (corba_access.h). Every call has a time limit. Idle connections are closed. Messages may be as
// large as images.
//
// Threads  call StartOrb() once per process, before any other use of CORBA.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include <omniORB4/CORBA.h>

#include "gsv/base/error.h"

namespace gsv::orb {

struct OrbOptions {
  std::string host = "127.0.0.1";  // the address that the ORB listens on
  int port = 0;                    // 0 lets the system choose the port
  bool local_socket = false;       // also listen on a local socket if possible, see local_socket.h
  std::uint64_t max_message_bytes = 64u << 20;  // maximum size of a message, including its header
  std::chrono::seconds message_time{30};        // time limit for receiving a message
  std::chrono::milliseconds call_timeout{10'000};  // default time limit of remote calls
  // A function that removes arguments that crash omniORB, see broker::CheckRequest(). Null for no
  // check.
  void (*check_request)(std::string& message) = nullptr;
  // The maximum number of connections to one server. Each call in progress needs its own
  // connection. So this must be at least the number of calls to one server at the same time.
  int max_connections_per_server = 4096;
};

// Starts the ORB and its root POA. Fails with a sentence if the port is in use, if a certificate is
// invalid, or if the address requires a certificate and there is none.
base::Result<CORBA::ORB_var> StartOrb(const OrbOptions& options);

// Returns this process's ORB. If there is none, starts one for outgoing calls only.
base::Result<CORBA::ORB_var> CallingOrb();

// Returns the root POA; the caller owns the reference.
PortableServer::POA_ptr RootPoa(CORBA::ORB_ptr orb);

// Returns the address of this machine that peers on `host` can use: the local address of the route
// to `host`. For a loopback host, it is "127.0.0.1".
base::Result<std::string> LocalAddressTowards(const std::string& host);

// Returns the host and port in a reference, by TCP or TLS, such as "127.0.0.1:40123"; empty if
// there is none.
std::string AddressOf(CORBA::Object_ptr object);

// Sets the time limit of calls through this reference, for all threads.
void LimitCalls(CORBA::Object_ptr object, std::chrono::milliseconds timeout);

}  // namespace gsv::orb
