// How many bytes may be on their way to one client: as many as its connection passes in a fraction
// of a second. Systems and proxies buffer megabytes, which a slow connection delivers seconds
// later. The client confirms what it received by the pongs of WebSocket pings (RFC 6455, section
// 5.5.3), which every client answers, and which stay behind the messages before them.
//
// If the delay of a pong exceeds the minimum delay, the messages before its ping have waited in
// buffers for the excess. Then the connection was busy, and its rate is the number of bytes that
// this pong confirms, divided by the time since the last pong. A full window may take the minimum
// delay and kMaxDelay; if it takes longer, it shrinks to what takes the minimum delay and
// kAimedDelay. If the window holds messages back and the excess is below half of kAimedDelay, the
// window doubles.
//
// The way itself may become longer, so the minimum delay ages. If it is older than kMinDelayAge and
// pongs exceed it, the window closes until everything is confirmed. Then a ping without data
// measures the minimum again.
//
// Threads  one.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace gsv::gateway {

class SendWindow {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  static constexpr std::size_t kFirstBytes = 16u << 10;
  static constexpr std::size_t kMinBytes = 8u << 10;
  static constexpr std::size_t kMaxBytes = 4u << 20;
  static constexpr std::chrono::milliseconds kAimedDelay{200}, kMaxDelay{300};
  // Limit of a minimum delay that was measured behind data, perhaps on a busy connection.
  static constexpr std::chrono::milliseconds kMaxMinDelay{500};
  static constexpr std::chrono::seconds kMinDelayAge{30};
  static constexpr std::chrono::milliseconds kPingPeriod{100};
  // A connection is slow when it was late for kSlowAfter, until it was in time for kInTimeAfter.
  static constexpr std::chrono::seconds kSlowAfter{2}, kInTimeAfter{5};

  // Whether another message may be sent. One always may if nothing is unconfirmed, unless the
  // minimum delay is being measured.
  bool is_open() const { return !measures_ && (unconfirmed() == 0 || unconfirmed() < bytes_); }
  // A message has to wait because the window is closed.
  void HoldBack() { holds_back_ = true; }
  // A message was handed to the system; `started`: the time before that. Only data count in the
  // window: control messages are sent in any case.
  void Sent(std::size_t bytes, bool is_data, Time started) {
    sent_ += bytes;
    if (is_data) data_sent_ += bytes;
    if (!first_started_) first_started_ = started;
  }

  // Whether a ping should follow now. Ask after each message and each pong.
  bool WantsPing(Time now) const;
  // A ping is sent after all messages so far. Returns its number. `started`: the start of the last
  // message if the ping follows it directly, else the present time.
  std::uint64_t Ping(Time now, Time started);
  void Pong(std::uint64_t number, Time now);
  // A pong without a number. It may answer a later ping, and clients may answer only the last one.
  void PongOfAny(Time now) {
    if (mark_) Pong(mark_->number, now);
  }

  // Data were left out because they had waited for too long.
  void LeftOut(Time now) { NoteLate(now, now); }
  bool IsSlow(Time now);
  // Whether a ping has no pong yet.
  bool is_pinging() const { return mark_.has_value(); }
  // The rate of a slow connection in bytes per second; null if the connection is fast.
  std::optional<double> slow_rate() const { return is_slow_ ? rate_ : std::nullopt; }

  std::size_t bytes() const { return bytes_; }
  std::size_t unconfirmed() const { return data_sent_ - data_confirmed_; }

 private:
  struct Mark {
    std::uint64_t number = 0;
    std::size_t data_position = 0;  // data bytes sent before the ping
    std::size_t bytes = 0;          // bytes sent after the ping before
    Time first_started{};           // start of these bytes
    Time started{};
    bool measures = false;  // nothing was unconfirmed before the ping, to measure the minimum delay
  };

  // A message that was sent or queued at `began` was late.
  void NoteLate(Time began, Time now);
  // Whether the ping without a pong is late already.
  bool IsOverdue(Time now) const;
  void TakeMinDelay(const Mark& mark, Time now);

  std::size_t bytes_ = kFirstBytes;
  std::size_t sent_ = 0;  // all bytes
  std::size_t data_sent_ = 0, data_confirmed_ = 0;
  std::optional<Mark> mark_;  // the ping without a pong
  std::uint64_t pings_ = 0;
  Time last_ping_{}, last_pong_{};
  std::size_t last_position_ = 0;      // bytes sent before the last ping
  std::optional<Time> first_started_;  // start of the messages after the last ping
  std::optional<Clock::duration> min_delay_;
  Time min_measured_{};      // when min_delay_ was measured
  bool measures_ = false;    // the minimum delay is being measured again
  bool holds_back_ = false;  // since the last pong
  bool is_slow_ = false;
  std::optional<double> rate_;
  std::optional<Time> first_late_, last_late_;
};

}  // namespace gsv::gateway
