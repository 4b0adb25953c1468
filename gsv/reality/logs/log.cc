#include "gsv/reality/logs/log.h"

#include <algorithm>
#include <cmath>

#include "gsv/geometry/constants.h"

namespace gsv::reality {

double WrappedAngle(double angle) { return std::remainder(angle, 2 * geometry::kPi); }

double Log::duration() const {
  double end = 0;
  const auto extend = [&](const auto& series) {
    if (!series.empty()) end = std::max(end, series.back().time);
  };
  extend(truth), extend(odometry), extend(commands), extend(wheels), extend(scans), extend(radio);
  return end;
}

std::optional<TimedPose> PoseAt(const std::vector<TimedPose>& poses, double time, double max_gap) {
  const auto after = std::lower_bound(poses.begin(), poses.end(), time,
                                      [](const TimedPose& p, double t) { return p.time < t; });
  if (after == poses.end()) return std::nullopt;
  if (after->time == time) return *after;
  if (after == poses.begin()) return std::nullopt;
  const TimedPose& a = *(after - 1);
  const TimedPose& b = *after;
  if (b.time - a.time > max_gap) return std::nullopt;
  const double part = (time - a.time) / (b.time - a.time);
  return TimedPose{time, a.x + part * (b.x - a.x), a.y + part * (b.y - a.y),
                   a.yaw + part * WrappedAngle(b.yaw - a.yaw)};
}

}  // namespace gsv::reality
