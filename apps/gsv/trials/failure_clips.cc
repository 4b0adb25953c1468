#include "apps/gsv/trials/failure_clips.h"

#include <algorithm>

#include "gsv/base/sorting.h"

namespace gsv::app {

std::vector<double> ViolationTimes(const nlohmann::ordered_json& report) {
  const double end = report.value("sim_time_s", 0.0);
  std::vector<double> times;
  for (const auto& expectation : report.value("expectations", nlohmann::ordered_json::array())) {
    if (!expectation.value("holds", true)) times.push_back(expectation.value("time_s", end));
  }
  if (times.empty()) times.push_back(end);
  base::Sort(times);
  return times;
}

std::vector<Clip> ClipsOf(const std::vector<double>& times, double before, double after) {
  std::vector<Clip> clips;
  for (const double time : times) {
    if (clips.empty() || time - clips.back().violations.front() > kMaxClipSpan) {
      if (clips.size() == kMaxClips) break;
      clips.push_back({std::max(0.0, time - before), 0, {}});
    }
    clips.back().to = time + after;
    clips.back().violations.push_back(time);
  }
  return clips;
}

}  // namespace gsv::app
