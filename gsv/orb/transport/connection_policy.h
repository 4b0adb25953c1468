// What a program adds to the connections of its ORB: limits on messages, and hooks that see each
// message before the ORB does.
//
// omniORB 4.2.5 takes what comes on a connection during a call for that call's if it has the call's
// number: a last fragment that comes twice has two threads work on one call, and the process dies.
// Therefore connections join fragments before the ORB sees them (ADR 023). What is no message, or
// too long, ends its connection. Requests to cancel are dropped.
//
// Threads  as each function says.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace gsv::orb {

struct MessageLimits {
  std::size_t bytes = 64u << 20;  // of a message, with its header
  std::chrono::seconds time{30};  // from a message's first byte to its last
};

// What hooks may do with their connection. Any thread.
class ConnectionControl {
 public:
  // Takes the bytes that have come, without waiting. Whether a read of the ORB would not wait.
  virtual bool Gather() = 0;
  // After Gather() was false: whether a part of a message has come.
  virtual bool has_begun() const = 0;
  // Has the thread that accepts watch for more bytes.
  virtual void Watch() = 0;
  // Ends the connection. The ORB then destroys it.
  virtual void End() = 0;

 protected:
  ~ConnectionControl() = default;
};

// The hooks of one connection, which are destroyed before it is. They are called by the threads
// that read and send.
class ConnectionHooks {
 public:
  virtual ~ConnectionHooks() = default;

  // The ORB asks for bytes, and no message has begun.
  virtual void OnWait() {}
  virtual void OnBytes() {}
  // `message` is complete. The hook may cut off what the ORB is not to see.
  virtual void OnMessage(std::string& message) { (void)message; }
  // The ORB sends `bytes`.
  virtual void OnSend(std::string_view bytes) { (void)bytes; }
  // The first `count` of them were sent.
  virtual void OnSent(std::size_t count) { (void)count; }
};

// What holds for all connections of the process's ORB.
struct ConnectionPolicy {
  // Makes a connection's hooks, or null.
  using MakeHooks = std::function<std::unique_ptr<ConnectionHooks>(ConnectionControl&)>;

  MessageLimits limits;
  MakeHooks accepted;  // for connections that clients make; may be empty
  // For connections that this process makes; may be empty. Without hooks the ORB gets their bytes
  // as they come.
  MakeHooks made;
  // Whether the ORB shall read now: bytes have come on an accepted connection, and no thread of the
  // ORB waits for them. May be empty: it shall. The thread that accepts calls it. The ORB may have
  // destroyed the connection meanwhile, so the function must know its connections by their hooks.
  std::function<bool(ConnectionControl*)> shall_read;
};

// Sets the policy for ORBs that are started, and connections that are made, from now on. Any
// thread.
void SetConnectionPolicy(ConnectionPolicy policy);
std::shared_ptr<const ConnectionPolicy> CurrentConnectionPolicy();

}  // namespace gsv::orb
