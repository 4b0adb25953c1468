#include "gsv/gateway/server/send_window.h"

namespace gsv::gateway {
namespace {

double Seconds(SendWindow::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

bool SendWindow::WantsPing(Time now) const {
  if (mark_) return false;
  if (measures_ && unconfirmed() == 0) return true;
  if (sent_ == last_position_) return false;
  return !is_open() || 2 * unconfirmed() >= bytes_ || now - last_ping_ >= kPingPeriod;
}

std::uint64_t SendWindow::Ping(Time now, Time started) {
  mark_ = Mark{++pings_,
               data_sent_,
               sent_ - last_position_,
               first_started_.value_or(now),
               started,
               measures_ && unconfirmed() == 0};
  last_ping_ = now;
  last_position_ = sent_;
  first_started_.reset();
  return mark_->number;
}

void SendWindow::Pong(std::uint64_t number, Time now) {
  if (!mark_ || mark_->number != number) return;
  const Mark mark = *mark_;
  mark_.reset();
  data_confirmed_ = mark.data_position;
  TakeMinDelay(mark, now);
  const Clock::duration minimum = *min_delay_;
  const Clock::duration excess = now - mark.started - minimum;
  const bool is_late = excess > kMaxDelay;
  // A short excess gives a useful rate only if the pong confirms a large part of the window.
  const bool is_significant = 4 * excess > kAimedDelay && 4 * mark.bytes >= bytes_;
  const Clock::duration busy = now - std::max(last_pong_, mark.first_started + minimum);
  last_pong_ = now;
  if (mark.bytes > 0 && busy > Clock::duration::zero() && (is_late || is_significant)) {
    rate_ = static_cast<double>(mark.bytes) / Seconds(busy);
    if (static_cast<double>(bytes_) > *rate_ * Seconds(minimum + kMaxDelay)) {
      bytes_ =
          std::max(kMinBytes, static_cast<std::size_t>(*rate_ * Seconds(minimum + kAimedDelay)));
    }
  }
  if (is_late) {
    NoteLate(mark.started, now);
  } else if (holds_back_ && !mark.measures && 2 * excess < kAimedDelay) {
    bytes_ = std::min(kMaxBytes, 2 * bytes_);
  }
  holds_back_ = false;
  if (4 * excess > kAimedDelay && now - min_measured_ > kMinDelayAge) measures_ = true;
}

void SendWindow::TakeMinDelay(const Mark& mark, Time now) {
  const Clock::duration delay = now - mark.started;
  const Clock::duration most = min_delay_.value_or(std::min<Clock::duration>(delay, kMaxMinDelay));
  if (min_delay_ && !mark.measures && delay > most) return;
  min_delay_ = mark.measures ? delay : std::min(most, delay);
  min_measured_ = now;
  if (mark.measures) measures_ = false;
}

void SendWindow::NoteLate(Time began, Time now) {
  if (!last_late_ || began - *last_late_ > kInTimeAfter) first_late_ = now;
  last_late_ = now;
  if (now - *first_late_ >= kSlowAfter) is_slow_ = true;
}

bool SendWindow::IsOverdue(Time now) const {
  const Clock::duration minimum = min_delay_.value_or(kMaxMinDelay);
  return mark_ && now - mark_->started > minimum + kMaxDelay;
}

bool SendWindow::IsSlow(Time now) {
  if (is_slow_ && now - *last_late_ > kInTimeAfter && !IsOverdue(now)) is_slow_ = false;
  return is_slow_;
}

}  // namespace gsv::gateway
