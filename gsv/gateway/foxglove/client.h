// A Client is a connected viewer. The server sends messages to the viewer through this interface.
//
// Threads  any; calls neither block nor call back.
#pragma once

#include <cstdint>
#include <string>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/foxglove.h"
#include "gsv/gateway/foxglove/shared_bytes.h"

namespace gsv::gateway {

// The reason for closing a connection (RFC 6455, section 7.4.1).
enum class CloseCode : std::uint16_t {
  kGoingAway = 1001,
  kProtocolError = 1002,
  kPolicyViolation = 1008,
  kTooBig = 1009,
  kTryAgainLater = 1013,
};

// kEach: messages are dropped only if the queue is full. kNewest: an unsent message may be dropped
// if a newer message of the same subscription is queued. See SendQueue.
enum class Delivery { kEach, kNewest };

// A connected viewer, to which the server sends messages.
class Client {
 public:
  virtual ~Client() = default;
  // Sends control messages, none of which is dropped.
  virtual void SendText(SharedBytes text) = 0;
  virtual void SendBytes(SharedBytes bytes) = 0;
  // Sends data. If the queue is full, older data are dropped (see SendQueue).
  virtual void SendData(const foxglove::BinaryHeader& header, SharedBytes payload,
                        Delivery delivery) = 0;
  // Returns the number of dropped data messages so far.
  virtual std::uint64_t dropped_updates() const { return 0; }
  // Returns the rate of a slow connection in bytes per second; 0 if it is fast enough.
  virtual double slow_rate() const { return 0; }
  // Returns an error with the reason if this viewer may not control the simulation now.
  virtual base::Status CheckControl() { return {}; }
  // Closes the connection, with this reason.
  virtual void Close(CloseCode code, std::string reason) = 0;

  // Sends a status message.
  void SendStatus(foxglove::StatusLevel level, std::string_view message) {
    SendText(SharedBytes(foxglove::StatusText(level, message)));
  }
};

}  // namespace gsv::gateway
