#include "gsv/gateway/replay/replay_clock.h"

#include <algorithm>
#include <string>

namespace gsv::gateway {
namespace {

using simulation::Phase;

// If more time than this has passed between two calls of Advance(), the replay becomes slower
// instead of skipping.
constexpr std::chrono::milliseconds kMaxRoundTime{200};

base::Status Refuse(const char* action, const char* needed, Phase phase) {
  return base::Fail(base::ErrorCode::kNotRunning, std::string("to ") + action +
                                                      " a replay it must be " + needed +
                                                      ", and it is " + ToString(phase));
}

}  // namespace

base::Status ReplayClock::Start() {
  if (phase_ != Phase::kCreated) return Refuse("start", "created", phase_);
  phase_ = Phase::kRunning;
  last_ = {};
  return {};
}

base::Status ReplayClock::Pause() {
  if (phase_ == Phase::kPaused) return {};
  if (phase_ != Phase::kRunning) return Refuse("pause", "running", phase_);
  phase_ = Phase::kPaused;
  return {};
}

base::Status ReplayClock::Resume() {
  if (phase_ == Phase::kRunning) return {};
  if (phase_ != Phase::kPaused) return Refuse("resume", "paused", phase_);
  phase_ = Phase::kRunning;
  last_ = {};
  return {};
}

base::Status ReplayClock::Step(base::SimTime time) {
  if (phase_ != Phase::kPaused && phase_ != Phase::kCreated) {
    return Refuse("step", "created or paused", phase_);
  }
  position_ += std::min(time, end_ - position_);
  phase_ = position_ == end_ ? Phase::kFinished : Phase::kPaused;
  return {};
}

void ReplayClock::Rewind() {
  position_ = start_;
  phase_ = Phase::kCreated;
}

void ReplayClock::Seek(base::SimTime time) {
  position_ = std::clamp(time, start_, end_);
  last_ = {};
  if (phase_ != Phase::kRunning) phase_ = Phase::kPaused;
}

void ReplayClock::SeekAndPause(base::SimTime time) {
  position_ = std::clamp(time, start_, end_);
  phase_ = Phase::kPaused;
}

bool ReplayClock::Advance(WallTime now) {
  if (phase_ != Phase::kRunning) return false;
  if (last_ == WallTime{}) last_ = now;
  const auto wall = std::min<std::chrono::nanoseconds>(now - last_, kMaxRoundTime);
  last_ = now;
  const double moved = static_cast<double>(wall.count()) * speed_;
  const auto left = static_cast<double>((end_ - position_).count());
  if (moved < left) {
    position_ += base::SimTime(static_cast<std::int64_t>(moved));
    return false;
  }
  // The messages up to the end are sent before the replay starts again.
  const bool starts_again = loop_ && position_ == end_;
  position_ = starts_again ? start_ : end_;
  if (!loop_) phase_ = Phase::kFinished;
  return starts_again;
}

}  // namespace gsv::gateway
