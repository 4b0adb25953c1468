#include "gsv/gateway/server/send_queue.h"

#include <utility>

namespace gsv::gateway {

bool SendQueue::PushControl(SharedBytes message, bool is_text) {
  const base::MutexLock lock(mutex_);
  if (control_bytes_ + message.size() > limits_.control_bytes) return false;
  control_bytes_ += message.size();
  control_.push_back({is_text, false, {}, std::move(message)});
  return true;
}

std::size_t SendQueue::PushData(const foxglove::BinaryHeader& header, SharedBytes payload) {
  Outgoing message{false, true, header, std::move(payload)};
  const base::MutexLock lock(mutex_);
  std::size_t dropped = 0;
  while (!data_.empty() && (data_.size() >= limits_.data_messages ||
                            data_bytes_ + message.size() > limits_.data_bytes)) {
    Take(data_, data_bytes_);
    ++dropped;
  }
  dropped_ += dropped;
  data_bytes_ += message.size();
  data_.push_back(std::move(message));
  return dropped;
}

std::optional<Outgoing> SendQueue::Pop() {
  const base::MutexLock lock(mutex_);
  if (!control_.empty()) return Take(control_, control_bytes_);
  if (!data_.empty()) return Take(data_, data_bytes_);
  return std::nullopt;
}

bool SendQueue::empty() const {
  const base::MutexLock lock(mutex_);
  return control_.empty() && data_.empty();
}

std::uint64_t SendQueue::dropped() const {
  const base::MutexLock lock(mutex_);
  return dropped_;
}

Outgoing SendQueue::Take(std::deque<Outgoing>& queue, std::size_t& bytes) {
  Outgoing message = std::move(queue.front());
  queue.pop_front();
  bytes -= message.size();
  return message;
}

}  // namespace gsv::gateway
