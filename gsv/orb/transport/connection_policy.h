// The policy for the connections of a program's ORB: limits on messages, and hooks that see each
// message before the ORB does.
//
// omniORB 4.2.5 assigns a fragment to the call with the same id, even if that call is complete. If
// the last fragment of a call arrives twice, two threads work on the call, and the process
// crashes. Therefore connections join fragments before the ORB sees them (ADR 023). A connection
// ends if it receives bytes that are no message, or a message that is too long. Cancel requests
// are dropped.
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

// Limits of incoming messages. A connection ends if a message exceeds them.
struct MessageLimits {
  std::size_t bytes = 64u << 20;  // maximum size of a message with its header
  std::chrono::seconds time{30};  // maximum time from the first byte of a message to the last
};

// Functions that hooks may call on their connection, on any thread.
class ConnectionControl {
 public:
  // Reads the received bytes without waiting. Returns whether the ORB can now read without waiting.
  virtual bool Gather() = 0;
  // Returns, after Gather() has returned false, whether part of a message was received.
  virtual bool has_begun() const = 0;
  // Makes the accepting thread watch for more bytes.
  virtual void Watch() = 0;
  // Ends the connection. The ORB then destroys it.
  virtual void End() = 0;

 protected:
  ~ConnectionControl() = default;
};

// Functions that a connection calls on the threads that read and send. The hooks are destroyed
// before their connection.
class ConnectionHooks {
 public:
  virtual ~ConnectionHooks() = default;

  // Called when the ORB wants to read and no message has begun.
  virtual void OnWait() {}
  // Called when bytes have been received, before they make a complete message.
  virtual void OnBytes() {}
  // Called with a complete message. The hook may remove the end of the message before the ORB sees
  // it.
  virtual void OnMessage(std::string& message) { (void)message; }
  // Called before the ORB sends `bytes`.
  virtual void OnSend(std::string_view bytes) { (void)bytes; }
  // Called after the first `count` of the bytes of OnSend() were sent.
  virtual void OnSent(std::size_t count) { (void)count; }
};

// Applies to all connections of the process's ORB.
struct ConnectionPolicy {
  // Makes the hooks of a connection. May return null for a connection without hooks.
  using MakeHooks = std::function<std::unique_ptr<ConnectionHooks>(ConnectionControl&)>;

  MessageLimits limits;
  MakeHooks accepted;  // for connections that clients open; may be empty
  // For connections that this process opens; may be empty. Without hooks, the ORB gets the bytes
  // unchanged.
  MakeHooks made;
  // Decides whether the ORB reads from an accepted connection now; empty means always. The thread
  // that accepts connections calls it when bytes arrive and no thread of the ORB waits for them.
  // The ORB may already have destroyed the connection, and with it the hooks. So the function must
  // compare the pointer with those of the hooks that still exist, before it uses the pointer.
  std::function<bool(ConnectionControl*)> shall_read;
};

// Sets the policy for all ORBs that are started later, and all connections that are made later. Can
// be called on any thread.
void SetConnectionPolicy(ConnectionPolicy policy);
std::shared_ptr<const ConnectionPolicy> CurrentConnectionPolicy();

}  // namespace gsv::orb
