// Selects the parts of a failed test's recording that `gsv test` keeps: some seconds around each
// violation.
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

namespace gsv::app {

// A part of a recording, in simulated seconds.
struct Clip {
  double from = 0, to = 0;         // start and end of the part
  std::vector<double> violations;  // times of the violations in this part, in ascending order
};

// The longest time between the first and the last violation of a clip, in simulated seconds.
inline constexpr double kMaxClipSpan = 120;
// The maximum number of clips. Later violations are in no clip.
inline constexpr std::size_t kMaxClips = 5;

// Returns the times of the violations in a report of `gsv run`, in ascending order. If there are
// none, returns the time at which the run ended.
std::vector<double> ViolationTimes(const nlohmann::ordered_json& report);

// Returns clips that contain the violations. A clip begins `before` seconds before its first
// violation, and contains all violations until kMaxClipSpan after the first. It ends `after`
// seconds after its last violation. `times` must be in ascending order.
std::vector<Clip> ClipsOf(const std::vector<double>& times, double before, double after);

}  // namespace gsv::app
