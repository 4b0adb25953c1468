// A SendQueue is the queue of messages to one client. Data with Delivery::kNewest are called state
// here.
//
// Newest   state that has waited for kMaxWait is dropped if a newer message of its subscription is
//          queued. So a slow connection gets fewer messages, and no outdated messages.
// Bounded  control messages (advertisements, answers) are never dropped. If they exceed their
//          limit, the client is disconnected. If data exceed their limit, state with a newer
//          message of its subscription is dropped first. If there is no such state, the oldest data
//          are dropped.
// Threads  any.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "gsv/base/mutex.h"
#include "gsv/gateway/foxglove/client.h"
#include "gsv/gateway/foxglove/foxglove.h"
#include "gsv/gateway/foxglove/shared_bytes.h"

namespace gsv::gateway {

// The limits of a SendQueue.
struct SendLimits {
  std::size_t control_bytes = 32u << 20;  // maximum size of queued control messages
  std::size_t data_bytes = 16u << 20;     // maximum size of queued data messages
  std::size_t data_messages = 256;        // maximum number of queued data messages
};

// A message in a SendQueue.
struct Outgoing {
  using Time = std::chrono::steady_clock::time_point;

  bool is_text = false;           // whether it is a text message, not a binary one
  bool is_data = false;           // false: a control message
  foxglove::BinaryHeader header;  // empty for control messages
  SharedBytes payload;
  Delivery delivery = Delivery::kEach;
  Time queued{};  // set only for data

  std::size_t size() const { return header.size + payload.size(); }
};

// The queue of messages to one client.
class SendQueue {
 public:
  using Time = Outgoing::Time;
  static constexpr std::chrono::milliseconds kMaxWait{200};  // see "Newest" above

  explicit SendQueue(const SendLimits& limits) : limits_(limits) {}

  // Queues a control message. If the queue is full, drops the message and returns false.
  [[nodiscard]] bool PushControl(SharedBytes message, bool is_text = true);
  // Always keeps the newest message. Returns the number of older messages that were dropped.
  std::size_t PushData(const foxglove::BinaryHeader& header, SharedBytes payload, Delivery delivery,
                       Time now);
  // The result of Pop().
  struct Popped {
    std::optional<Outgoing> message;  // nullopt if there is no message
    std::size_t left_out = 0;         // number of older data messages that were dropped
  };
  // Removes and returns the next message: control messages first, then data, each in order. If
  // `allows_data` is false, returns only control messages.
  Popped Pop(Time now, bool allows_data = true);

  bool empty() const;
  // Whether data messages are queued.
  bool has_data() const;
  std::uint64_t dropped() const;  // number of dropped data messages so far

 private:
  // Removes and returns the queue's first message, and subtracts its size from `bytes`.
  static Outgoing Take(std::deque<Outgoing>& queue, std::size_t& bytes);
  // Drops one data message, because `incoming` does not fit.
  void DropFor(const Outgoing& incoming) GSV_REQUIRES(mutex_);
  // Whether the message is state, and a newer message of its subscription is queued.
  bool IsReplaced(std::deque<Outgoing>::const_iterator message) const GSV_REQUIRES(mutex_);
  // Whether the oldest data message has waited for kMaxWait, and a newer message replaces it.
  bool IsOutdated(Time now) const GSV_REQUIRES(mutex_);

  const SendLimits limits_;
  mutable base::Mutex mutex_;
  // advertisements and answers, which are never dropped
  std::deque<Outgoing> control_ GSV_GUARDED_BY(mutex_);
  std::deque<Outgoing> data_ GSV_GUARDED_BY(mutex_);  // messages of subscriptions
  std::size_t control_bytes_ GSV_GUARDED_BY(mutex_) = 0, data_bytes_ = 0;
  std::uint64_t dropped_ GSV_GUARDED_BY(mutex_) = 0;  // number of dropped data messages so far
};

}  // namespace gsv::gateway
