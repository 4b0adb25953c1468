#include "gsv/simulation/pace/run_statistics.h"

namespace gsv::simulation {
namespace {

constexpr auto kWindow = std::chrono::seconds(1);
constexpr auto kSampleEvery = std::chrono::milliseconds(100);

double Ratio(base::SimTime time, WallDuration wall) {
  return wall.count() > 0 ? static_cast<double>(time.count()) /
                                static_cast<double>(std::chrono::nanoseconds(wall).count())
                          : 0.0;
}

}  // namespace

void RunStatistics::Started(WallTime wall, base::SimTime time) {
  running_ = true;
  start_ = latest_ = {wall, time};
  recent_.assign(1, start_);
}

void RunStatistics::Stepped(WallTime wall, base::SimTime time, WallDuration duration, int steps) {
  in_steps_ += duration;
  steps_ += steps;
  latest_ = {wall, time};
  if (wall - recent_.back().wall < kSampleEvery) return;
  recent_.push_back(latest_);
  while (recent_.size() > 2 && wall - recent_[1].wall >= kWindow) recent_.pop_front();
}

void RunStatistics::Stopped(WallTime wall, base::SimTime time) {
  if (!running_) return;
  running_ = false;
  wall_before_ += wall - start_.wall;
  time_before_ += time - start_.time;
}

double RunStatistics::real_time_factor() const {
  if (!running_) return Ratio(time_before_, wall_before_);
  return Ratio(latest_.time - recent_.front().time, latest_.wall - recent_.front().wall);
}

WallDuration RunStatistics::mean_step_time() const {
  return steps_ > 0 ? in_steps_ / steps_ : WallDuration{};
}

WallDuration RunStatistics::wall_time() const {
  return running_ ? wall_before_ + (latest_.wall - start_.wall) : wall_before_;
}

}  // namespace gsv::simulation
