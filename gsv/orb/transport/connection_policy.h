// The policy for the connections of a program's ORB: limits on messages, and hooks that see each
// message before the ORB does.
//
// omniORB 4.2.5 assigns a fragment to the call with its number, even if the call is complete. If a
// last fragment comes twice, two threads work on one call, and the process crashes. Therefore
// connections join fragments before the ORB sees them (ADR 023). Bytes that are no message, and a
// message that is too long, end their connection. Cancel requests are dropped.
//
// Threads  see each function.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace gsv::orb {

struct MessageLimits {
  std::size_t bytes = 64u << 20;  // maximum size of a message with its header
  std::chrono::seconds time{30};  // maximum time from a message's first byte to its last
};

// The operations of hooks on their connection. Any thread.
class ConnectionControl {
 public:
  // Reads the received bytes without waiting. True if a read by the ORB would not wait.
  virtual bool Gather() = 0;
  // After Gather() returned false: whether a part of a message was received.
  virtual bool has_begun() const = 0;
  // Makes the accepting thread watch for more bytes.
  virtual void Watch() = 0;
  // Ends the connection. The ORB then destroys it.
  virtual void End() = 0;

 protected:
  ~ConnectionControl() = default;
};

// The hooks of one connection. They are destroyed before the connection. The threads that read and
// send call them.
class ConnectionHooks {
 public:
  virtual ~ConnectionHooks() = default;

  // The ORB wants to read, and no message has begun.
  virtual void OnWait() {}
  virtual void OnBytes() {}
  // `message` is complete. The hook may remove a part at its end before the ORB sees it.
  virtual void OnMessage(std::string& message) { (void)message; }
  // The ORB sends `bytes`.
  virtual void OnSend(std::string_view bytes) { (void)bytes; }
  // The first `count` of these bytes were sent.
  virtual void OnSent(std::size_t count) { (void)count; }
};

// The policy that applies to all connections of the process's ORB.
struct ConnectionPolicy {
  // Makes a connection's hooks, or null.
  using MakeHooks = std::function<std::unique_ptr<ConnectionHooks>(ConnectionControl&)>;

  MessageLimits limits;
  MakeHooks accepted;  // for connections that clients open; may be empty
  // For connections that this process opens; may be empty. Without hooks the ORB gets the bytes
  // unchanged.
  MakeHooks made;
  // Whether the ORB shall read now; empty: always. The accepting thread calls it if bytes arrive on
  // an accepted connection for which no thread of the ORB waits. The ORB may have destroyed the
  // connection meanwhile, so the function must recognise its connections by their hooks.
  std::function<bool(ConnectionControl*)> shall_read;
};

// Sets the policy for all ORBs that are started later, and all connections that are made later. Any
// thread.
void SetConnectionPolicy(ConnectionPolicy policy);
std::shared_ptr<const ConnectionPolicy> CurrentConnectionPolicy();

}  // namespace gsv::orb
