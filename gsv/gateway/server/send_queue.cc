#include "gsv/gateway/server/send_queue.h"

#include <algorithm>
#include <span>
#include <utility>

namespace gsv::gateway {
namespace {

// Returns the bytes that name the stream of a message: the opcode and the subscription, or only the
// opcode if the message has no subscription. A newer message replaces an older message of the same
// stream.
std::span<const std::uint8_t> StreamOf(const foxglove::BinaryHeader& header) {
  const bool has_subscription = header.size == header.bytes.size();
  return std::span(header.bytes).first(has_subscription ? 5 : 1);
}

bool IsSameStream(const Outgoing& a, const Outgoing& b) {
  return std::ranges::equal(StreamOf(a.header), StreamOf(b.header));
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
    DropFor(message);
    ++dropped;
  }
  dropped_ += dropped;
  data_bytes_ += message.size();
  data_.push_back(std::move(message));
  return dropped;
}

void SendQueue::DropFor(const Outgoing& incoming) {
  const auto replaced = std::find_if(data_.begin(), data_.end(), [&](const Outgoing& message) {
    return message.delivery == Delivery::kNewest && IsSameStream(message, incoming);
  });
  auto victim = replaced;
  if (victim == data_.end()) {
    for (victim = data_.begin(); victim != data_.end() && !IsReplaced(victim); ++victim) {
    }
  }
  if (victim == data_.end()) victim = data_.begin();
  data_bytes_ -= victim->size();
  data_.erase(victim);
}

bool SendQueue::IsReplaced(std::deque<Outgoing>::const_iterator message) const {
  return message->delivery == Delivery::kNewest &&
         std::any_of(message + 1, data_.cend(),
                     [&](const Outgoing& newer) { return IsSameStream(newer, *message); });
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
  return now - data_.front().queued >= kMaxWait && IsReplaced(data_.begin());
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
