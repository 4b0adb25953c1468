#include "gsv/gateway/server/send_queue.h"

#include <algorithm>
#include <span>
#include <utility>

namespace gsv::gateway {
namespace {

// Opcode and subscription of a message, or only the opcode if it has no subscription.
std::span<const std::uint8_t> StreamOf(const foxglove::BinaryHeader& header) {
  const bool has_subscription = header.size == header.bytes.size();
  return std::span(header.bytes).first(has_subscription ? 5 : 1);
}

}  // namespace

bool SendQueue::PushControl(SharedBytes message, bool is_text) {
  const base::MutexLock lock(mutex_);
  if (control_bytes_ + message.size() > limits_.control_bytes) return false;
  control_bytes_ += message.size();
  control_.push_back({.is_text = is_text, .payload = std::move(message)});
  return true;
}

std::size_t SendQueue::PushData(const foxglove::BinaryHeader& header, SharedBytes payload,
                                Delivery delivery, Time now) {
  Outgoing message{.is_data = true,
                   .header = header,
                   .payload = std::move(payload),
                   .delivery = delivery,
                   .queued = now};
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

SendQueue::Popped SendQueue::Pop(Time now, bool allows_data) {
  const base::MutexLock lock(mutex_);
  Popped popped;
  if (!control_.empty()) {
    popped.message = Take(control_, control_bytes_);
    return popped;
  }
  if (!allows_data) return popped;
  while (IsOutdated(now)) {
    Take(data_, data_bytes_);
    ++popped.left_out;
  }
  dropped_ += popped.left_out;
  if (!data_.empty()) popped.message = Take(data_, data_bytes_);
  return popped;
}

bool SendQueue::IsOutdated(Time now) const {
  if (data_.empty()) return false;
  const Outgoing& oldest = data_.front();
  if (oldest.delivery != Delivery::kNewest || now - oldest.queued < kMaxWait) return false;
  return std::any_of(data_.begin() + 1, data_.end(), [&](const Outgoing& newer) {
    return std::ranges::equal(StreamOf(newer.header), StreamOf(oldest.header));
  });
}

bool SendQueue::empty() const {
  const base::MutexLock lock(mutex_);
  return control_.empty() && data_.empty();
}

bool SendQueue::has_data() const {
  const base::MutexLock lock(mutex_);
  return !data_.empty();
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
