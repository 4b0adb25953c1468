// What waits to be written to one client.
//
// Bounded  Control messages (what there is to subscribe to, answers) must all arrive: when too much
//          of them waits, the client is beyond help. Of the data the oldest makes room for the
//          newest.
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
  bool is_data = false;           // else control
  foxglove::BinaryHeader header;  // of control: empty
  SharedBytes payload;

  std::size_t size() const { return header.size + payload.size(); }
};

class SendQueue {
 public:
  explicit SendQueue(const SendLimits& limits) : limits_(limits) {}

  // False: too much waits already; the message was not queued.
  [[nodiscard]] bool PushControl(SharedBytes message, bool is_text = true);
  // The newest message is always kept, however large it is. Gives how many older ones were dropped.
  std::size_t PushData(const foxglove::BinaryHeader& header, SharedBytes payload);
  // The next to be written: control before data, each in the order it came.
  std::optional<Outgoing> Pop();

  bool empty() const;
  std::uint64_t dropped() const;  // data messages so far

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
