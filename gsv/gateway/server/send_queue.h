// The queue of messages to one client.
//
// Bounded  control messages (advertisements, answers) are never dropped; if they exceed the limit,
//          the client is disconnected. If data exceed their limit, the oldest are dropped.
// Threads  any.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "gsv/base/mutex.h"
#include "gsv/gateway/foxglove/foxglove.h"
#include "gsv/gateway/foxglove/shared_bytes.h"

namespace gsv::gateway {

struct SendLimits {
  std::size_t control_bytes = 32u << 20;
  std::size_t data_bytes = 16u << 20;
  std::size_t data_messages = 256;
};

struct Outgoing {
  bool is_text = false;
  bool is_data = false;           // false: control
  foxglove::BinaryHeader header;  // empty for control messages
  SharedBytes payload;

  std::size_t size() const { return header.size + payload.size(); }
};

class SendQueue {
 public:
  explicit SendQueue(const SendLimits& limits) : limits_(limits) {}

  // Returns false if the queue is full; the message was not queued.
  [[nodiscard]] bool PushControl(SharedBytes message, bool is_text = true);
  // Always keeps the newest message. Returns the number of dropped older ones.
  std::size_t PushData(const foxglove::BinaryHeader& header, SharedBytes payload);
  // Returns the next message: control messages before data, each kind in order.
  std::optional<Outgoing> Pop();

  bool empty() const;
  std::uint64_t dropped() const;  // number of dropped data messages so far

 private:
  static Outgoing Take(std::deque<Outgoing>& queue, std::size_t& bytes);

  const SendLimits limits_;
  mutable base::Mutex mutex_;
  std::deque<Outgoing> control_ GSV_GUARDED_BY(mutex_);
  std::deque<Outgoing> data_ GSV_GUARDED_BY(mutex_);
  std::size_t control_bytes_ GSV_GUARDED_BY(mutex_) = 0, data_bytes_ = 0;
  std::uint64_t dropped_ GSV_GUARDED_BY(mutex_) = 0;
};

}  // namespace gsv::gateway
