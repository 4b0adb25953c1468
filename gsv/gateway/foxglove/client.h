// One connected viewer, as those see it who send.
//
// Threads  any; no call blocks, and none calls back.
#pragma once

#include <cstdint>
#include <string>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/foxglove.h"
#include "gsv/gateway/foxglove/shared_bytes.h"

namespace gsv::gateway {

// Why a connection is closed, as in RFC 6455, section 7.4.1.
enum class CloseCode : std::uint16_t {
  kGoingAway = 1001,
  kProtocolError = 1002,
  kPolicyViolation = 1008,
  kTooBig = 1009,
  kTryAgainLater = 1013,
};

class Client {
 public:
  virtual ~Client() = default;
  // Control messages, none of which is lost.
  virtual void SendText(SharedBytes text) = 0;
  virtual void SendBytes(SharedBytes bytes) = 0;
  // Data, of which the oldest makes room for the newest.
  virtual void SendData(const foxglove::BinaryHeader& header, SharedBytes payload) = 0;
  // How many data messages made room for newer ones, so far.
  virtual std::uint64_t dropped_updates() const { return 0; }
  // Why this viewer may not act now, but only look.
  virtual base::Status CheckControl() { return {}; }
  virtual void Close(CloseCode code, std::string reason) = 0;

  void SendStatus(foxglove::StatusLevel level, std::string_view message) {
    SendText(SharedBytes(foxglove::StatusText(level, message)));
  }
};

}  // namespace gsv::gateway
