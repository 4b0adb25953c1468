// A SendWindow limits the data that were sent to one client and are not yet confirmed. The limit is
// the number of bytes that the connection transfers in a fraction of a second. Without this limit,
// operating systems and proxies buffer megabytes, which a slow connection delivers seconds late.
// Confirmations are the pongs to WebSocket pings (RFC 6455, section 5.5.3). Every client answers
// pings, and a ping arrives after the messages that were sent before the ping.
//
// The delay of a pong is the time from its ping to the pong. The part of this delay that exceeds
// the minimum delay is the excess: the messages before the ping have waited in buffers for this
// time. If there is an excess, the connection was busy, so its rate is known: the number of bytes
// that the pong confirms, divided by the time since the previous pong. At this rate, a full window
// should not take longer than the minimum delay plus kMaxDelay. If it takes longer, the window
// shrinks to a size that takes the minimum delay plus kAimedDelay. The window doubles if messages
// had to wait for the window and the excess is below half of kAimedDelay.
//
// The minimum delay may increase, for example after a change of the route. If it was measured
// longer than kMinDelayAge ago, and the excess of a pong is above a quarter of kAimedDelay, the
// window closes until all data are confirmed. Then a ping without data measures the minimum delay
// again.
//
// Threads  one thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace gsv::gateway {

// Limits the data that one client has not yet confirmed.
class SendWindow {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  static constexpr std::size_t kFirstBytes = 16u << 10;  // size of the window at the start
  static constexpr std::size_t kMinBytes = 8u << 10;     // minimum size of the window
  static constexpr std::size_t kMaxBytes = 4u << 20;     // maximum size of the window
  // Delays of a full window in addition to the minimum delay, see above.
  static constexpr std::chrono::milliseconds kAimedDelay{200}, kMaxDelay{300};
  // A ping that is sent after data may have to wait for the data, so its delay may be longer than
  // the minimum delay. A minimum delay that was measured in this way is limited to this value.
  static constexpr std::chrono::milliseconds kMaxMinDelay{500};
  static constexpr std::chrono::seconds kMinDelayAge{30};  // see above
  // While data are sent, the time between two pings is not much longer than this.
  static constexpr std::chrono::milliseconds kPingPeriod{100};
  // A pong is late if its delay exceeds the minimum delay by more than kMaxDelay. A connection
  // counts as slow after its pongs were late for kSlowAfter. It counts as fast again after no pong
  // was late for kInTimeAfter.
  static constexpr std::chrono::seconds kSlowAfter{2}, kInTimeAfter{5};

  // Whether a data message may be sent now. If all data are confirmed, a message of any size may be
  // sent, except while the minimum delay is being measured.
  bool is_open() const { return !measures_ && (unconfirmed() == 0 || unconfirmed() < bytes_); }
  // Notes that a message has to wait because the window is closed.
  void HoldBack() { holds_back_ = true; }
  // Notes that a message was passed to the system. `started` is the time at which passing it began.
  // Only data count in the window, because control messages are sent even while the window is
  // closed.
  void Sent(std::size_t bytes, bool is_data, Time started) {
    sent_ += bytes;
    if (is_data) data_sent_ += bytes;
    if (!first_started_) first_started_ = started;
  }

  // Whether to send a ping now. Call this after each message and each pong.
  bool WantsPing(Time now) const;
  // Notes that a ping is sent after all messages so far, and returns its number. The delay of its
  // pong counts from `started`: the start of the last message if the ping is sent directly after
  // this message, otherwise `now`.
  std::uint64_t Ping(Time now, Time started);
  // Notes the pong of the ping with this number.
  void Pong(std::uint64_t number, Time now);
  // Notes a pong without a number, which answers a keep-alive ping. Such a pong also confirms a
  // numbered ping that was sent earlier, because clients may answer only the last ping.
  void PongOfAny(Time now) {
    if (mark_) Pong(mark_->number, now);
  }

  // Notes that data were dropped because they had waited for too long.
  void LeftOut(Time now) { NoteLate(now, now); }
  // Whether the connection counts as slow now, see kSlowAfter.
  bool IsSlow(Time now);
  // Whether a ping has no pong yet.
  bool is_pinging() const { return mark_.has_value(); }
  // Returns the rate of a slow connection in bytes per second; nullopt if the connection is fast.
  std::optional<double> slow_rate() const { return is_slow_ ? rate_ : std::nullopt; }

  // The size of the window.
  std::size_t bytes() const { return bytes_; }
  // The number of data bytes that were sent and not confirmed.
  std::size_t unconfirmed() const { return data_sent_ - data_confirmed_; }

 private:
  // A ping, and the state when it was sent.
  struct Mark {
    std::uint64_t number = 0;
    std::size_t data_position = 0;  // data bytes sent before the ping
    std::size_t bytes = 0;          // bytes sent since the previous ping
    Time first_started{};           // start of the first message after the previous ping
    Time started{};                 // see Ping()
    // whether the ping measures the minimum delay: all data were confirmed before it
    bool measures = false;
  };

  // Notes a late pong, or data that were dropped because they had waited too long. Late pongs and
  // dropped data belong to one series unless more than kInTimeAfter lies between them. `began` is
  // the start of the pong's delay, or the time at which the data were dropped.
  void NoteLate(Time began, Time now);
  // Whether the last ping has waited too long for its pong.
  bool IsOverdue(Time now) const;
  // Updates the minimum delay with the delay of this pong.
  void TakeMinDelay(const Mark& mark, Time now);

  std::size_t bytes_ = kFirstBytes;                 // size of the window
  std::size_t sent_ = 0;                            // all bytes that were sent
  std::size_t data_sent_ = 0, data_confirmed_ = 0;  // data bytes that were sent and confirmed
  std::optional<Mark> mark_;                        // the ping without a pong
  std::uint64_t pings_ = 0;                         // number of pings so far
  Time last_ping_{}, last_pong_{};
  std::size_t last_position_ = 0;             // bytes sent before the last ping
  std::optional<Time> first_started_;         // start of the first message after the last ping
  std::optional<Clock::duration> min_delay_;  // the minimum delay; nullopt before the first pong
  Time min_measured_{};                       // when min_delay_ was measured
  bool measures_ = false;                     // whether the minimum delay is being measured again
  bool holds_back_ = false;                   // whether a message had to wait since the last pong
  bool is_slow_ = false;                      // see IsSlow()
  std::optional<double> rate_;                // bytes/s, measured when the connection was last busy
  std::optional<Time> first_late_, last_late_;  // first and last time of a series, see NoteLate()
};

}  // namespace gsv::gateway
